#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <numeric>
#include <opencv2/core/types.hpp>
#include <string>
#include <utility>
#include <vector>

#include "services/segmentation/lib/model_description.hpp"
#include "tests/support/onnx_writer.hpp"

namespace tsg::test {

/// One output of a made-up network; its numbers are in `integers` where it is of int64.
struct MadeOutput {
  std::string name;
  std::vector<std::int64_t> shape;
  std::vector<float> floats = {};
  std::vector<std::int64_t> integers = {};
  bool is_integer = false;

  /// Of float32, filled with zeros.
  static MadeOutput zeros(std::string name, std::vector<std::int64_t> shape) {
    const auto count =
        std::accumulate(shape.begin(), shape.end(), std::int64_t{1}, std::multiplies<>());
    return {.name = std::move(name),
            .shape = std::move(shape),
            .floats = std::vector<float>(static_cast<std::size_t>(count), 0.0F)};
  }
};

/// What a made-up network takes and gives: as decoders see it, and as an ONNX file.
struct MadeNetwork {
  cv::Size input_size;
  int classes = 0;
  std::vector<MadeOutput> outputs = {};

  [[nodiscard]] ModelDescription description() const {
    ModelDescription model;
    model.inputs = {{.name = "image", .shape = {1, 3, input_size.height, input_size.width}}};
    for (const MadeOutput& output : outputs) {
      const auto type = output.is_integer ? ElementType::kInt64 : ElementType::kFloat32;
      model.outputs.push_back({.name = output.name, .shape = output.shape, .type = type});
    }
    return model;
  }

  /// Views of `outputs`.
  [[nodiscard]] std::vector<TensorView> views() const {
    std::vector<TensorView> made;
    for (const MadeOutput& output : outputs) {
      made.push_back({.shape = output.shape, .floats = output.floats, .integers = output.integers});
    }
    return made;
  }

  /// "class 0", "class 1", ...
  [[nodiscard]] std::vector<std::string> class_names() const {
    std::vector<std::string> names;
    names.reserve(static_cast<std::size_t>(classes));
    for (int i = 0; i < classes; ++i) names.push_back("class " + std::to_string(i));
    return names;
  }

  /// The content of an .onnx file that gives these outputs for every image. With `is_dynamic`,
  /// dimension 1 of all is one that only shows in a run. Names classes if `has_names`.
  [[nodiscard]] std::string onnx(bool has_names, bool is_dynamic = false) const {
    OnnxWriter model;
    model.add_input("image", {1, 3, input_size.height, input_size.width});
    add_nothing(model);
    for (const MadeOutput& output : outputs) {
      const std::string source = output.name + "_numbers";
      if (output.is_integer) {
        model.add_constant(source, output.shape, std::span(output.integers));
      } else {
        model.add_constant(source, output.shape, std::span(output.floats));
      }
      OnnxWriter::Shape shape = output.shape;
      if (is_dynamic) shape.at(1) = -1;
      model.add_output(output.name, shape, output.is_integer);
      if (is_dynamic) {
        add_chosen(model, output);
      } else {
        model.add_node("Identity", {source}, output.name);
      }
    }
    if (has_names) model.add_metadata("names", names_as_dictionary());
    return model.bytes();
  }

 private:
  /// "nothing" = 0, of the image, so that the runtime cannot know it beforehand.
  static void add_nothing(OnnxWriter& model) {
    const std::vector<float> zero{0.0F};
    model.add_constant("zero", {}, std::span(zero));
    model.add_node("Mul", {"image", "zero"}, "zeros");
    model.add_node("ReduceMax", {"zeros"}, "nothing");
  }

  /// The numbers along dimension 1 for which 1 + nothing > 0: all.
  static void add_chosen(OnnxWriter& model, const MadeOutput& output) {
    const std::vector<float> ones(static_cast<std::size_t>(output.shape.at(1)), 1.0F);
    model.add_constant(output.name + "_ones", {output.shape.at(1)}, std::span(ones));
    model.add_node("Add", {output.name + "_ones", "nothing"}, output.name + "_sums");
    model.add_node("Greater", {output.name + "_sums", "zero"}, output.name + "_chosen");
    model.add_node("Compress", {output.name + "_numbers", output.name + "_chosen"}, output.name);
  }

  [[nodiscard]] std::string names_as_dictionary() const {
    std::string text;
    for (int i = 0; i < classes; ++i) {
      text += (i == 0 ? "{" : ", ") + std::to_string(i) + ": 'class " + std::to_string(i) + "'";
    }
    return text + "}";
  }
};

}  // namespace tsg::test
