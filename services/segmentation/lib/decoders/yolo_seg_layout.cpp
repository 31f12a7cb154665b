#include "services/segmentation/lib/decoders/yolo_seg_layout.hpp"

#include "services/segmentation/lib/decoders/input_image.hpp"

namespace tsg {

namespace {

constexpr const char* kHowToExportYolo =
    "; a YOLOv8/11 segmentation network is to be exported to ONNX with a fixed input size "
    "(dynamic=False), batch 1 and without NMS";

tl::unexpected<Error> no_yolo_seg(const std::string& what) {
  return make_error(ExitCode::kUnsupportedModel, what + kHowToExportYolo);
}

bool has_shape_of(const TensorDescription& tensor, std::size_t rank) {
  return tensor.type == ElementType::kFloat32 && tensor.shape.size() == rank &&
         tensor.has_fixed_shape() && tensor.shape.front() == 1;
}

}  // namespace

Expected<YoloSegLayout> yolo_seg_layout(const ModelDescription& model, const ClassNames& names) {
  const auto input_size = size_of_input_image(model);
  if (!input_size) return tl::unexpected(input_size.error());
  const auto& outputs = model.outputs;
  if (outputs.size() != 2 || !has_shape_of(outputs[0], 3) || !has_shape_of(outputs[1], 4)) {
    return no_yolo_seg("the outputs are not detections [1,4+C+M,A] and prototypes [1,M,H/4,W/4]: " +
                       to_string(outputs));
  }
  YoloSegLayout layout{.input_size = *input_size,
                       .prototype_size = {static_cast<int>(outputs[1].shape[3]),
                                          static_cast<int>(outputs[1].shape[2])},
                       .anchors = static_cast<int>(outputs[0].shape[2]),
                       .coefficients = static_cast<int>(outputs[1].shape[1]),
                       .class_names = names.names};
  if (layout.input_size != layout.prototype_size * 4) {
    return no_yolo_seg("the mask prototypes " + outputs[1].to_string() +
                       " are not a quarter of the input " + model.inputs[0].to_string());
  }
  const std::int64_t classes = outputs[0].shape[1] - kBoxNumbers - layout.coefficients;
  if (classes < 1) {
    return no_yolo_seg("the output " + outputs[0].to_string() + " has no room for 4 numbers of a " +
                       "box, class scores and " + std::to_string(layout.coefficients) +
                       " mask coefficients for each anchor");
  }
  if (auto counted = check_class_count(names, classes); !counted) {
    return tl::unexpected(counted.error());
  }
  return layout;
}

}  // namespace tsg
