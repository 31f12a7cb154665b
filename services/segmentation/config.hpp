#pragma once

#include <string>
#include <vector>

#include "common/app/config_file.hpp"
#include "common/rgbd/mask_faults.hpp"
#include "services/segmentation/lib/model_provider.hpp"
#include "services/segmentation/scheduling.hpp"

namespace tsg {

/// Of provider "remote".
struct RemoteConfig {
  int jpeg_quality = 80;  // a VGA frame has some 60 kB; below 60 networks begin to miss things
  // One is computed while the next one travels; more would only wait in a queue.
  int frames_under_way = 2;
  int patience_ms = 1000;  // after that long without an answer the next frame is sent

  [[nodiscard]] std::vector<std::string> problems() const;
};

struct SegmentationConfig {
  std::string input = "camera";     // "camera", or "network" to work for a robot's "remote"
  std::string provider = "model";   // "model", "dataset" or "remote"
  std::string dataset_folder = {};  // with mask/ and instances.json; for provider "dataset"
  ModelProviderConfig network = {};
  bool uses_shipped_network = false;  // as model.file names none
  RemoteConfig remote = {};
  Scheduling scheduling = {};
  MaskFaults faults = {};  // for evaluation only

  [[nodiscard]] std::vector<std::string> problems() const;
};

/// Reads section "segmentation". Throws FatalError (kConfig) naming everything that is wrong.
[[nodiscard]] SegmentationConfig load_segmentation_config(const ConfigFile& file);

}  // namespace tsg
