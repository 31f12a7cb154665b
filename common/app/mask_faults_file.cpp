#include "common/app/mask_faults_file.hpp"

namespace tsg {

void read_mask_faults(ConfigReader& reader, const std::string& prefix, MaskFaults& faults) {
  reader.read(prefix + "late_frames", faults.late_frames);
  reader.read(prefix + "every_frames", faults.every_frames);
  reader.read(prefix + "drop_every", faults.drop_every);
  reader.read(prefix + "drop_instance_every", faults.drop_instance_every);
  reader.read(prefix + "merge_two", faults.merge_two);
  reader.read(prefix + "shrink_px", faults.shrink_px);
  reader.read(prefix + "swap_class_every", faults.swap_class_every);
}

}  // namespace tsg
