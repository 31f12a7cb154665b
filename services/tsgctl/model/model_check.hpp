#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "common/core/error.hpp"
#include "services/segmentation/lib/input_format.hpp"
#include "services/segmentation/lib/model_provider.hpp"
#include "services/segmentation/lib/segmentation_provider.hpp"

namespace tsg {

/// What a segmentation network is, and what the segmentation service does with it.
struct ModelCheck {
  std::string file;
  std::string layout;
  std::string input;    ///< "image float32 [1,3,256,320]"
  std::string outputs;  ///< the same of all of them
  InputFormat format;
  std::vector<std::string> classes;
  std::string class_source;  ///< "metadata" or the labels file
  int threads = 0;
  int instances_in_noise = 0;
  SegmentationTimes times;  ///< of one frame of VGA size, not the first
};

/// Loads the network and runs it on noise. The errors of ModelProvider::make() and segment(),
/// naming the file: kInvalidNumber where the network gives NaN.
[[nodiscard]] Expected<ModelCheck> check_model(const ModelProviderConfig& config);

[[nodiscard]] std::string to_text(const ModelCheck& check);
[[nodiscard]] nlohmann::json to_json(const ModelCheck& check);

}  // namespace tsg
