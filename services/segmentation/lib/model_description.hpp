#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace tsg {

/// What the numbers of a tensor are; of networks' outputs the first two are understood.
enum class ElementType { kFloat32, kInt64, kOther };

/// One input or output of a network; a dimension that is not fixed is -1.
struct TensorDescription {
  std::string name;
  std::vector<std::int64_t> shape;
  ElementType type = ElementType::kFloat32;

  [[nodiscard]] bool has_fixed_shape() const;

  /// "images float32 [1,3,480,640]".
  [[nodiscard]] std::string to_string() const;
};

/// "dets float32 [1,?,5], labels int64 [1,?]"; "none" where there are none.
[[nodiscard]] std::string to_string(const std::vector<TensorDescription>& tensors);

/// What a model file says of itself.
struct ModelDescription {
  std::vector<TensorDescription> inputs = {};
  std::vector<TensorDescription> outputs = {};
  std::map<std::string, std::string> metadata = {};
};

/// The numbers of one output after a run: of the two spans, that of its type is filled.
struct TensorView {
  std::vector<std::int64_t> shape = {};  ///< the real one, whatever the description leaves open
  std::span<const float> floats = {};
  std::span<const std::int64_t> integers = {};
};

}  // namespace tsg
