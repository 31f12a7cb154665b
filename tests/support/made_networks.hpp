#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "tests/support/network_outputs.hpp"

namespace tsg::test {

/// An object that a made-up network sees: an ellipse, in shares of the input.
struct MadeObject {
  int class_id = 0;
  float score = 0.9F;
  cv::Point2f centre = {0.5F, 0.5F};
  cv::Size2f radii = {0.2F, 0.2F};

  /// 1 at the centre, 0 at the edge, negative outside.
  [[nodiscard]] float depth(float x, float y) const {
    const float dx = (x - centre.x) / radii.width;
    const float dy = (y - centre.y) / radii.height;
    return 1.0F - dx * dx - dy * dy;
  }
};

/// Logits of an object's mask at each pixel of an image, from 8 to -8.
inline void draw_logits(const MadeObject& object, cv::Size size, float* logits) {
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      const float depth =
          object.depth((static_cast<float>(x) + 0.5F) / static_cast<float>(size.width),
                       (static_cast<float>(y) + 0.5F) / static_cast<float>(size.height));
      *logits++ = std::clamp(8.0F * depth, -8.0F, 8.0F);
    }
  }
}

/// Objects that partly overlap, in random places.
inline std::vector<MadeObject> random_objects(int count, int classes, std::mt19937& random) {
  std::uniform_real_distribution<float> unit(0.0F, 1.0F);
  std::vector<MadeObject> objects;
  objects.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) {
    objects.push_back({.class_id = static_cast<int>(unit(random) * static_cast<float>(classes)),
                       .score = 0.4F + 0.55F * unit(random),
                       .centre = {unit(random), unit(random)},
                       .radii = {0.06F + 0.2F * unit(random), 0.06F + 0.2F * unit(random)}});
  }
  return objects;
}

struct MadeSolov2 {
  cv::Size input_size = {160, 128};
  std::array<int, 5> grids = {40, 36, 24, 16, 12};
  int classes = 7;
  int kernel_length = 24;  ///< as many objects at most
  bool is_merged = false;
  float noise = 1.0F;  ///< 0: each object is found once, nothing else

  /// Outputs in which `objects` are found, each by two cells of one grid and one of another, so
  /// that NMS has work. Raw: scores and kernels of the finest grid, of the next ..., feature.
  [[nodiscard]] MadeNetwork network(const std::vector<MadeObject>& objects,
                                    std::mt19937& random) const {
    Cells cells = background(random);
    for (std::size_t i = 0; i < objects.size(); ++i) {
      const std::size_t level = i % grids.size();
      put(cells, {level, 0}, objects[i], i);
      if (noise == 0.0F) continue;
      put(cells, {level, -1}, objects[i], i);
      put(cells, {level, 1}, objects[i], i);
      put(cells, {(level + 1) % grids.size(), 0}, objects[i], i);
    }
    MadeNetwork made{.input_size = input_size, .classes = classes};
    made.outputs = is_merged ? merged(cells) : raw(cells);
    made.outputs.push_back(feature(objects, random));
    return made;
  }

 private:
  /// Scores (0..1) and kernels, cell by cell.
  struct Cells {
    std::vector<float> scores;
    std::vector<float> kernels;
  };
  struct Place {
    std::size_t level;
    int beside;  ///< cells to the right of the object's
  };

  [[nodiscard]] std::size_t first_cell(std::size_t level) const {
    std::size_t first = 0;
    for (std::size_t i = 0; i < level; ++i) {
      first += static_cast<std::size_t>(grids.at(i)) * static_cast<std::size_t>(grids.at(i));
    }
    return first;
  }

  Cells background(std::mt19937& random) const {
    std::normal_distribution<float> normal;
    const std::size_t count = first_cell(grids.size());
    Cells cells{std::vector<float>(count * static_cast<std::size_t>(classes)),
                std::vector<float>(count * static_cast<std::size_t>(kernel_length))};
    for (float& score : cells.scores) {
      score = 1.0F / (1.0F + std::exp(5.0F - noise * normal(random)));
    }
    for (float& number : cells.kernels) number = noise * 0.02F * normal(random);
    return cells;
  }

  void put(Cells& cells, const Place& place, const MadeObject& object, std::size_t channel) const {
    const int size = grids.at(place.level);
    const int x = std::clamp(
        static_cast<int>(object.centre.x * static_cast<float>(size)) + place.beside, 0, size - 1);
    const int y =
        std::clamp(static_cast<int>(object.centre.y * static_cast<float>(size)), 0, size - 1);
    const std::size_t cell = first_cell(place.level) + static_cast<std::size_t>(y * size + x);
    const float weaker = place.beside == 0 ? 1.0F : 0.9F;
    cells.scores[cell * static_cast<std::size_t>(classes) +
                 static_cast<std::size_t>(object.class_id)] = object.score * weaker;
    cells.kernels[cell * static_cast<std::size_t>(kernel_length) + channel] = weaker;
  }

  [[nodiscard]] std::vector<MadeOutput> merged(const Cells& cells) const {
    const auto count = static_cast<std::int64_t>(first_cell(grids.size()));
    return {{.name = "cate_pred", .shape = {count, classes}, .floats = cells.scores},
            {.name = "kernel_pred", .shape = {count, kernel_length}, .floats = cells.kernels}};
  }

  /// Planes of one grid from numbers cell by cell.
  [[nodiscard]] MadeOutput planes(const std::string& name,
                                  std::size_t level,
                                  int channels,
                                  const std::vector<float>& numbers) const {
    const int size = grids.at(level);
    MadeOutput output = MadeOutput::zeros(name + std::to_string(level), {1, channels, size, size});
    const auto cells = static_cast<std::size_t>(size) * static_cast<std::size_t>(size);
    const auto count = static_cast<std::size_t>(channels);
    for (std::size_t cell = 0; cell < cells; ++cell) {
      for (std::size_t i = 0; i < count; ++i) {
        output.floats[i * cells + cell] = numbers[(first_cell(level) + cell) * count + i];
      }
    }
    return output;
  }

  [[nodiscard]] std::vector<MadeOutput> raw(const Cells& cells) const {
    std::vector<MadeOutput> outputs;
    for (std::size_t level = 0; level < grids.size(); ++level) {
      MadeOutput scores = planes("cate_", level, classes, cells.scores);
      for (float& score : scores.floats) score = std::log(score / (1.0F - score));
      outputs.push_back(std::move(scores));
      outputs.push_back(planes("kernel_", level, kernel_length, cells.kernels));
    }
    return outputs;
  }

  MadeOutput feature(const std::vector<MadeObject>& objects, std::mt19937& random) const {
    std::normal_distribution<float> normal;
    const cv::Size size = input_size / 4;
    MadeOutput output = MadeOutput::zeros("mask_feat", {1, kernel_length, size.height, size.width});
    for (std::size_t i = 0; i < objects.size(); ++i) {
      draw_logits(objects[i], size,
                  output.floats.data() + i * static_cast<std::size_t>(size.area()));
    }
    for (float& number : output.floats) number += noise * 0.3F * normal(random);
    return output;
  }
};

enum class MadeMasks { kProbabilities, kLogits, kZeroOrOne };

/// Outputs of an RTMDet-Ins network: dets, labels, masks.
inline MadeNetwork made_rtmdet(cv::Size input_size,
                               int classes,
                               const std::vector<MadeObject>& objects,
                               MadeMasks kind) {
  const auto count = static_cast<std::int64_t>(objects.size());
  MadeOutput boxes{.name = "dets", .shape = {1, count, 5}};
  MadeOutput labels{.name = "labels", .shape = {1, count}, .is_integer = true};
  MadeOutput masks = MadeOutput::zeros("masks", {1, count, input_size.height, input_size.width});
  const auto width = static_cast<float>(input_size.width);
  const auto height = static_cast<float>(input_size.height);
  float* mask = masks.floats.data();
  for (const MadeObject& object : objects) {
    const auto& [centre, radii] = std::pair(object.centre, object.radii);
    boxes.floats.insert(
        boxes.floats.end(),
        {(centre.x - radii.width) * width, (centre.y - radii.height) * height,
         (centre.x + radii.width) * width, (centre.y + radii.height) * height, object.score});
    labels.integers.push_back(object.class_id);
    draw_logits(object, input_size, mask);
    mask += input_size.area();
  }
  for (float& number : masks.floats) {
    if (kind == MadeMasks::kProbabilities) number = 1.0F / (1.0F + std::exp(-number));
    if (kind == MadeMasks::kZeroOrOne) number = number > 0.0F ? 1.0F : 0.0F;
  }
  return {.input_size = input_size,
          .classes = classes,
          .outputs = {std::move(boxes), std::move(labels), std::move(masks)}};
}

/// Outputs of a YOLO-seg network in which each of `objects` is found twice, once a little aside.
inline MadeNetwork made_yolo_seg(cv::Size input_size,
                                 int classes,
                                 const std::vector<MadeObject>& objects) {
  const auto count = static_cast<std::int64_t>(objects.size());
  const std::int64_t anchors = 2 * count;
  MadeOutput numbers = MadeOutput::zeros("output0", {1, 4 + classes + count, anchors});
  const auto at = [&](std::int64_t row, std::int64_t anchor) -> float& {
    return numbers.floats[static_cast<std::size_t>(row * anchors + anchor)];
  };
  const cv::Size size = input_size / 4;
  MadeOutput prototypes = MadeOutput::zeros("output1", {1, count, size.height, size.width});
  const auto width = static_cast<float>(input_size.width);
  const auto height = static_cast<float>(input_size.height);
  for (std::int64_t anchor = 0; anchor < anchors; ++anchor) {
    const std::int64_t index = anchor / 2;
    const MadeObject& object = objects[static_cast<std::size_t>(index)];
    const float aside = anchor % 2 == 0 ? 0.0F : 0.01F;
    at(0, anchor) = (object.centre.x + aside) * width;
    at(1, anchor) = object.centre.y * height;
    at(2, anchor) = 2.0F * object.radii.width * width;
    at(3, anchor) = 2.0F * object.radii.height * height;
    at(4 + object.class_id, anchor) = object.score * (1.0F - aside);
    at(4 + classes + index, anchor) = 1.0F;
    draw_logits(object, size, prototypes.floats.data() + index * size.area());
  }
  return {.input_size = input_size,
          .classes = classes,
          .outputs = {std::move(numbers), std::move(prototypes)}};
}

}  // namespace tsg::test
