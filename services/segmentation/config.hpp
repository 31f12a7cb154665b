#pragma once

#include <string>
#include <vector>

#include "common/app/config_file.hpp"
#include "common/rgbd/mask_faults.hpp"
#include "services/segmentation/lib/model_provider.hpp"

namespace tsg {

struct SegmentationConfig {
  std::string provider = "model";   // "model" or "dataset"
  std::string dataset_folder = {};  // with mask/ and instances.json; for provider "dataset"
  ModelProviderConfig network = {};
  int nice = 5;            // on a busy machine tracking must win over masks
  MaskFaults faults = {};  // for evaluation only

  [[nodiscard]] std::vector<std::string> problems() const;
};

/// Reads section "segmentation". Throws FatalError (kConfig) naming everything that is wrong.
[[nodiscard]] SegmentationConfig load_segmentation_config(const ConfigFile& file);

}  // namespace tsg
