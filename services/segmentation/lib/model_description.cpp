#include "services/segmentation/lib/model_description.hpp"

#include <algorithm>

namespace tsg {

namespace {

const char* name_of(ElementType type) {
  switch (type) {
    case ElementType::kFloat32:
      return " float32 [";
    case ElementType::kInt64:
      return " int64 [";
    case ElementType::kOther:
      break;
  }
  return " (neither float32 nor int64) [";
}

}  // namespace

bool TensorDescription::has_fixed_shape() const {
  constexpr std::int64_t kLongest = 1 << 24;  // of any dimension; more is a damaged file
  return std::all_of(shape.begin(), shape.end(),
                     [](std::int64_t length) { return length > 0 && length <= kLongest; });
}

std::string TensorDescription::to_string() const {
  std::string text = name + name_of(type);
  for (std::size_t i = 0; i < shape.size(); ++i) {
    text += (i == 0 ? "" : ",") + (shape[i] < 0 ? std::string("?") : std::to_string(shape[i]));
  }
  return text + "]";
}

std::string to_string(const std::vector<TensorDescription>& tensors) {
  std::string text;
  for (const auto& tensor : tensors) text += (text.empty() ? "" : ", ") + tensor.to_string();
  return text.empty() ? "none" : text;
}

}  // namespace tsg
