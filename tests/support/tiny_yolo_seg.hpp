#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "tests/support/onnx_writer.hpp"

namespace tsg::test {

/// What a network does where an image has white in it.
enum class InWhite { kWorks, kGivesNan, kFails };

/// A network of the YOLO-seg layout for 64 x 32 images, classes "person" and "tv", that finds the
/// same in every image: a person in the left half, score 0.9 (or whatever `score` is).
struct TinyYoloSeg {
  float score = 0.9F;
  /// Layers that do nothing but take time, about 1 ms each: exponentials of 3 x 480 x 640 numbers.
  int slow_layers = 0;
  InWhite in_white = InWhite::kWorks;

  static constexpr int kWidth = 64;
  static constexpr int kHeight = 32;

  /// The .onnx file's content.
  [[nodiscard]] std::string bytes() const {
    const bool is_slow = slow_layers > 0;
    const std::int64_t height = is_slow ? 480 : kHeight;
    const std::int64_t width = is_slow ? 640 : kWidth;
    OnnxWriter model;
    model.add_input("images", {1, 3, height, width});
    model.add_output("output0", {1, kNumbers, kAnchors});
    model.add_output("output1", {1, 1, height / 4, width / 4});
    model.add_constant("anchors", {1, kNumbers, kAnchors}, anchors(width, height));
    const std::vector<float> masks(static_cast<std::size_t>(height * width / 16), 10.0F);
    model.add_constant("masks", {1, 1, height / 4, width / 4}, masks);
    add_layers(model);
    model.add_node("Identity", {"masks"}, "output1");
    model.add_metadata("names", "{0: 'person', 1: 'tv'}");
    return model.bytes();
  }

 private:
  static constexpr std::size_t kNumbers = 4 + 2 + 1;
  static constexpr std::size_t kAnchors = 3;

  [[nodiscard]] std::vector<float> anchors(std::int64_t width, std::int64_t height) const {
    std::vector<float> numbers(kNumbers * kAnchors, 0.0F);
    const auto w = static_cast<float>(width);
    const auto h = static_cast<float>(height);
    numbers[0] = w / 4;  // centre x of the first anchor, and so on
    numbers[kAnchors] = h / 2;
    numbers[2 * kAnchors] = w / 2 - 1;
    numbers[3 * kAnchors] = h - 1;
    numbers[4 * kAnchors] = score;
    numbers[6 * kAnchors] = 1.0F;  // its mask is the only prototype
    return numbers;
  }

  /// output0 = anchors + (a number from the image that is zero).
  void add_layers(OnnxWriter& model) const {
    const std::vector<float> zero{0.0F};
    model.add_constant("zero", {}, zero);
    model.add_node("Mul", {"images", "zero"}, "layer0");
    for (int i = 0; i < slow_layers; ++i) {  // tanh(0) = 0
      model.add_node("Tanh", {"layer" + std::to_string(i)}, "layer" + std::to_string(i + 1));
    }
    model.add_node("ReduceMax", {"layer" + std::to_string(slow_layers)}, "nothing");
    if (in_white == InWhite::kWorks) {
      model.add_node("Add", {"anchors", "nothing"}, "output0");
      return;
    }
    model.add_node("Add", {"anchors", "nothing"}, "sound");
    add_whiteness(model);
    model.add_node("Add", {"sound", "flaw"}, "output0");
  }

  /// "flaw": numbers to be added to the anchors, 0 where there is no white.
  void add_whiteness(OnnxWriter& model) const {
    const std::vector<float> less_than_white{-0.75F};
    model.add_constant("less_than_white", {}, less_than_white);
    model.add_node("ReduceMax", {"images"}, "brightest");
    model.add_node("Add", {"brightest", "less_than_white"}, "above");
    model.add_node("Relu", {"above"}, "white");
    if (in_white == InWhite::kGivesNan) {
      model.add_node("Neg", {"white"}, "not_white");
      model.add_node("Sqrt", {"not_white"}, "flaw");
      return;
    }
    // One number for all anchors; two, in white, fit none.
    const std::vector<float> zeros{0.0F, 0.0F};
    const std::vector<float> one_of_two{1.0F, 0.0F};
    model.add_constant("two_zeros", {1, 2, 1}, zeros);
    model.add_constant("one_of_two", {2}, one_of_two);
    model.add_node("Add", {"one_of_two", "white"}, "wanted");
    model.add_node("Greater", {"wanted", "zero"}, "chosen");
    model.add_node("Compress", {"two_zeros", "chosen"}, "flaw");
  }
};

}  // namespace tsg::test
