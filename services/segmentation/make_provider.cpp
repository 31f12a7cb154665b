#include "services/segmentation/make_provider.hpp"

#include <string>

#include "common/core/check.hpp"
#include "services/segmentation/lib/dataset_provider.hpp"
#include "services/segmentation/lib/model_provider.hpp"

namespace tsg {

namespace {

tl::unexpected<Error> not_set(const std::string& key, const std::string& provider) {
  return make_error(ExitCode::kConfig, "segmentation." + key + " is not set, which provider '" +
                                           provider + "' needs: set it in the configuration or " +
                                           "with --set segmentation." + key + "=PATH");
}

}  // namespace

Expected<std::unique_ptr<SegmentationProvider>> make_provider(const SegmentationConfig& config) {
  TSG_CHECK(config.provider != "remote");
  if (config.provider == "dataset") {
    if (config.dataset_folder.empty()) return not_set("dataset.folder", config.provider);
    return DatasetProvider::make(config.dataset_folder);
  }
  if (config.network.model.file.empty()) return not_set("model.file", config.provider);
  return ModelProvider::make(config.network);
}

}  // namespace tsg
