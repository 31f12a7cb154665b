#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tsg::test {

/// Writes small ONNX files, so that tests need no network from elsewhere: the few fields of
/// onnx.proto that they use, in protobuf's wire format.
class OnnxWriter {
 public:
  using Shape = std::vector<std::int64_t>;

  void add_input(std::string_view name, const Shape& shape) {
    graph_ += field(11, value_info(name, shape, kFloat));
  }
  /// Of float32, else of int64.
  void add_output(std::string_view name, const Shape& shape, bool is_integer = false) {
    graph_ += field(12, value_info(name, shape, is_integer ? kInteger : kFloat));
  }
  /// A tensor that nodes take as input.
  void add_constant(std::string_view name, const Shape& shape, std::span<const float> values) {
    add_tensor(name, shape, kFloat,
               {reinterpret_cast<const char*>(values.data()), values.size_bytes()});
  }
  void add_constant(std::string_view name,
                    const Shape& shape,
                    std::span<const std::int64_t> values) {
    add_tensor(name, shape, kInteger,
               {reinterpret_cast<const char*>(values.data()), values.size_bytes()});
  }
  void add_node(std::string_view operation,
                const std::vector<std::string>& inputs,
                std::string_view output) {
    std::string node;
    for (const auto& input : inputs) node += field(1, input);
    graph_ += field(1, node + field(2, output) + field(4, operation) + attributes_of(operation));
  }
  void add_metadata(std::string_view key, std::string_view value) {
    metadata_ += field(14, field(1, key) + field(2, value));
  }

  /// The file's content.
  [[nodiscard]] std::string bytes() const {
    constexpr std::int64_t kIrVersion = 8;
    constexpr std::int64_t kOpset = 13;
    return field(1, kIrVersion) + field(7, graph_ + field(2, "test")) +
           field(8, field(1, "") + field(2, kOpset)) + metadata_;
  }

 private:
  static constexpr std::int64_t kFloat = 1;
  static constexpr std::int64_t kInteger = 7;

  void add_tensor(std::string_view name,
                  const Shape& shape,
                  std::int64_t type,
                  std::string_view bytes) {
    std::string tensor;
    for (const std::int64_t length : shape) tensor += field(1, length);
    graph_ += field(5, tensor + field(2, type) + field(8, name) + field(9, bytes));
  }

  static std::string varint(std::uint64_t value) {
    std::string bytes;
    while (value >= 0x80U) {
      bytes += static_cast<char>((value & 0x7FU) | 0x80U);
      value >>= 7U;
    }
    return bytes + static_cast<char>(value);
  }
  static std::string field(std::uint32_t number, std::int64_t value) {
    return varint(number << 3U) + varint(static_cast<std::uint64_t>(value));
  }
  static std::string field(std::uint32_t number, std::string_view content) {
    return varint((number << 3U) | 2U) + varint(content.size()) + std::string(content);
  }
  static std::string value_info(std::string_view name, const Shape& shape, std::int64_t type) {
    std::string dimensions;
    for (const std::int64_t length : shape) {  // none given where the size is not fixed
      dimensions += field(1, length > 0 ? field(1, length) : std::string());
    }
    const std::string tensor_type = field(1, type) + field(2, dimensions);
    return field(1, name) + field(2, field(1, tensor_type));
  }
  /// ReduceMax shall give a number, not a tensor of the input's rank; Compress works along
  /// dimension 1; Conv keeps the size with kernels of 3 x 3.
  static std::string attributes_of(std::string_view operation) {
    if (operation == "ReduceMax") return attribute("keepdims", 0);
    if (operation == "Compress") return attribute("axis", 1);
    if (operation == "Conv") return attribute("pads", Shape{1, 1, 1, 1});
    return {};
  }
  static std::string attribute(std::string_view name, std::int64_t value) {
    constexpr std::int64_t kInt = 2;
    return field(5, field(1, name) + field(3, value) + field(20, kInt));
  }

  static std::string attribute(std::string_view name, const Shape& values) {
    constexpr std::int64_t kInts = 7;
    std::string numbers;
    for (const std::int64_t value : values) numbers += field(8, value);
    return field(5, field(1, name) + numbers + field(20, kInts));
  }

  std::string graph_;
  std::string metadata_;
};

}  // namespace tsg::test
