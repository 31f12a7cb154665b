#pragma once

#include <opencv2/core/types.hpp>

#include "common/core/error.hpp"
#include "services/segmentation/lib/model_description.hpp"

namespace tsg {

/// The size of the one image that the network takes, a float32 tensor [1, 3, H, W].
/// kUnsupportedModel, saying what it takes and how to export, where it takes anything else.
[[nodiscard]] Expected<cv::Size> size_of_input_image(const ModelDescription& model);

}  // namespace tsg
