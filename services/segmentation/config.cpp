#include "services/segmentation/config.hpp"

#include "common/app/mask_faults_file.hpp"
#include "common/app/shipped_files.hpp"

namespace tsg {

std::vector<std::string> RemoteConfig::problems() const {
  constexpr int kMostUnderWay = 4;  // as many as the topics keep
  std::vector<std::string> found;
  if (jpeg_quality < 1 || jpeg_quality > 100) found.emplace_back("jpeg_quality must be 1 to 100");
  if (frames_under_way < 1 || frames_under_way > kMostUnderWay) {
    found.emplace_back("frames_under_way must be 1 to 4");
  }
  if (patience_ms < 10 || patience_ms > 60'000) {
    found.emplace_back("patience_ms must be 10 to 60000");
  }
  return found;
}

std::vector<std::string> SegmentationConfig::problems() const {
  std::vector<std::string> found;
  if (provider != "model" && provider != "dataset" && provider != "remote") {
    found.emplace_back("provider must be model, dataset or remote, not '" + provider + "'");
  }
  if (input != "camera" && input != "network") {
    found.emplace_back("input must be camera or network, not '" + input + "'");
  }
  if (input == "network" && provider == "remote") {
    found.emplace_back(
        "provider must be model or dataset where input is network: a host that "
        "works for another does not send frames on");
  }
  if (faults.any() && (input == "network" || provider == "remote")) {
    found.emplace_back("faults work with input camera and provider model or dataset only");
  }
  for (const auto& problem : remote.problems()) found.push_back("remote." + problem);
  for (const auto& problem : scheduling.problems()) found.push_back(problem);
  for (const auto& problems : {network.model.problems(), network.decoder.problems()}) {
    for (const auto& problem : problems) found.push_back("model." + problem);
  }
  for (const auto& problem : faults.problems()) found.push_back("faults." + problem);
  return found;
}

SegmentationConfig load_segmentation_config(const ConfigFile& file) {
  SegmentationConfig config;
  ConfigReader reader(file, "segmentation");
  reader.read("input", config.input);
  reader.read("provider", config.provider);
  reader.read("remote.jpeg_quality", config.remote.jpeg_quality);
  reader.read("remote.frames_under_way", config.remote.frames_under_way);
  reader.read("remote.patience_ms", config.remote.patience_ms);
  reader.read("nice", config.scheduling.nice);
  reader.read("cpus", config.scheduling.cpus);
  reader.read("dataset.folder", config.dataset_folder);
  reader.read("model.file", config.network.model.file);
  reader.read("model.labels", config.network.labels_file);
  reader.read("model.runtime_library", config.network.model.runtime_library);
  reader.read("model.threads", config.network.model.threads);
  reader.read("model.provider", config.network.model.provider);
  reader.read("model.provider_required", config.network.model.provider_required);
  reader.read("model.score_threshold", config.network.decoder.score_threshold);
  reader.read("model.nms_iou", config.network.decoder.nms_iou);
  read_mask_faults(reader, "faults.", config.faults);
  reader.finish(config.problems());
  if (config.provider == "model" && config.network.model.file.empty()) {
    // Empty still where the installation is not whole: then the node tells that the key is not set.
    config.network.model.file = find_shipped_network().value_or("").string();
    config.uses_shipped_network = !config.network.model.file.empty();
  }
  return config;
}

}  // namespace tsg
