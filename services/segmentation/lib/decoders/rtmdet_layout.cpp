#include "services/segmentation/lib/decoders/rtmdet_layout.hpp"

#include <cstdint>
#include <optional>

#include "services/segmentation/lib/decoders/input_image.hpp"

namespace tsg {

namespace {

/// Dimensions of an expected output; kAny may be of any length, or open.
constexpr std::int64_t kAny = -1;

bool fits(const TensorDescription& tensor,
          ElementType type,
          const std::vector<std::int64_t>& shape) {
  if (tensor.type != type || tensor.shape.size() != shape.size()) return false;
  for (std::size_t i = 0; i < shape.size(); ++i) {
    const bool is_open = shape[i] == kAny || tensor.shape[i] < 0;
    if (!is_open && tensor.shape[i] != shape[i]) return false;
  }
  return true;
}

std::optional<std::size_t> find(const ModelDescription& model,
                                ElementType type,
                                const std::vector<std::int64_t>& shape) {
  for (std::size_t i = 0; i < model.outputs.size(); ++i) {
    if (fits(model.outputs[i], type, shape)) return i;
  }
  return std::nullopt;
}

}  // namespace

Expected<RtmdetLayout> rtmdet_layout(const ModelDescription& model, const ClassNames& names) {
  const auto input_size = size_of_input_image(model);
  if (!input_size) return tl::unexpected(input_size.error());
  const auto boxes = find(model, ElementType::kFloat32, {1, kAny, 5});
  const auto classes = find(model, ElementType::kInt64, {1, kAny});
  const auto masks =
      find(model, ElementType::kFloat32, {1, kAny, input_size->height, input_size->width});
  if (!boxes || !classes || !masks) {
    return make_error(ExitCode::kUnsupportedModel,
                      "the outputs are not those of RTMDet-Ins: " + to_string(model.outputs) +
                          "; export dets float32 [1,N,5], labels int64 [1,N] and masks float32 "
                          "[1,N,H,W] of the input's size, with NMS inside");
  }
  return RtmdetLayout{.input_size = *input_size,
                      .boxes = *boxes,
                      .classes = *classes,
                      .masks = *masks,
                      .class_names = names.names};
}

}  // namespace tsg
