#include "services/tsgctl/run/sequence.hpp"

#include "common/core/error.hpp"
#include "common/dataset/instance_truth.hpp"
#include "common/dataset/tum_folder.hpp"

namespace tsg {

bool has_true_masks(const std::filesystem::path& folder) {
  return std::filesystem::is_directory(folder / "mask") &&
         std::filesystem::exists(folder / "instances.json");
}

Sequence open_sequence(const RunOptions& options) {
  Sequence sequence;
  sequence.frames = value_or_throw(open_tum_folder(options.input)).frames.size();
  const std::filesystem::path truth = options.input / "groundtruth.txt";
  if (std::filesystem::exists(truth)) {
    sequence.ground_truth = value_or_throw(read_trajectory(truth));
  }
  if (options.segmentation == SegmentationSource::kDataset) {
    (void)value_or_throw(InstanceTruth::open(options.input));
  }
  if (options.segmentation == SegmentationSource::kModel &&
      !std::filesystem::exists(options.model)) {
    throw FatalError(ExitCode::kMissingInput,
                     options.model.string() + ": no such file; --model needs a network in ONNX");
  }
  return sequence;
}

}  // namespace tsg
