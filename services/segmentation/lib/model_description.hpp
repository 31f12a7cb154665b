#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace tsg {

/// One input or output of a network; a dimension that is not fixed is -1.
struct TensorDescription {
  std::string name;
  std::vector<std::int64_t> shape;
  bool is_float32 = true;

  /// "images float32 [1,3,480,640]".
  [[nodiscard]] std::string to_string() const;
};

/// What a model file says of itself.
struct ModelDescription {
  std::vector<TensorDescription> inputs;
  std::vector<TensorDescription> outputs;
  std::map<std::string, std::string> metadata;
};

}  // namespace tsg
