#include "services/segmentation/lib/decoders/input_image.hpp"

namespace tsg {

Expected<cv::Size> size_of_input_image(const ModelDescription& model) {
  const auto unsupported = [&](const std::string& what) {
    return make_error(ExitCode::kUnsupportedModel,
                      what + ": " + to_string(model.inputs) +
                          "; export with batch 1 and a fixed input size (dynamic=False)");
  };
  if (model.inputs.size() != 1) return unsupported("the input is not one float32 image [1,3,H,W]");
  const TensorDescription& input = model.inputs.front();
  if (input.type != ElementType::kFloat32 || input.shape.size() != 4) {
    return unsupported("the input is not one float32 image [1,3,H,W]");
  }
  if (!input.has_fixed_shape()) return unsupported("the input has no fixed size");
  if (input.shape[0] != 1 || input.shape[1] != 3) {
    return unsupported("the input is not one float32 image [1,3,H,W]");
  }
  return cv::Size(static_cast<int>(input.shape[3]), static_cast<int>(input.shape[2]));
}

}  // namespace tsg
