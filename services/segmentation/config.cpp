#include "services/segmentation/config.hpp"

#include "common/app/mask_faults_file.hpp"

namespace tsg {

std::vector<std::string> SegmentationConfig::problems() const {
  std::vector<std::string> found;
  if (provider != "model" && provider != "dataset") {
    found.emplace_back("provider must be model or dataset, not '" + provider + "'");
  }
  if (nice < 0 || nice > 19) found.emplace_back("nice must be 0 to 19");
  for (const auto& problems : {network.model.problems(), network.decoder.problems()}) {
    for (const auto& problem : problems) found.push_back("model." + problem);
  }
  for (const auto& problem : faults.problems()) found.push_back("faults." + problem);
  return found;
}

SegmentationConfig load_segmentation_config(const ConfigFile& file) {
  SegmentationConfig config;
  ConfigReader reader(file, "segmentation");
  reader.read("provider", config.provider);
  reader.read("nice", config.nice);
  reader.read("dataset.folder", config.dataset_folder);
  reader.read("model.file", config.network.model.file);
  reader.read("model.labels", config.network.labels_file);
  reader.read("model.runtime_library", config.network.model.runtime_library);
  reader.read("model.threads", config.network.model.threads);
  reader.read("model.score_threshold", config.network.decoder.score_threshold);
  reader.read("model.nms_iou", config.network.decoder.nms_iou);
  read_mask_faults(reader, "faults.", config.faults);
  reader.finish(config.problems());
  return config;
}

}  // namespace tsg
