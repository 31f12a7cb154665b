#include "services/segmentation/lib/decoders/yolo_seg_decoder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <random>

namespace tsg {
namespace {

using testing::HasSubstr;

/// Outputs of a made-up network for 64 x 32 images: 3 classes, 4 prototypes, 42 anchors.
class Network {
 public:
  Network()
      : anchors_(static_cast<std::size_t>((4 + 3 + 4) * kAnchors), 0.0F),
        prototypes_(static_cast<std::size_t>(4 * 16 * 8), 0.0F) {}

  static constexpr int kAnchors = 42;
  YoloSegLayout layout{.input_size = {64, 32},
                       .prototype_size = {16, 8},
                       .anchors = kAnchors,
                       .coefficients = 4,
                       .class_names = {"person", "chair", "tv"}};

  float& at(int row, int anchor) {
    const int index = row * kAnchors + anchor;
    return anchors_[static_cast<std::size_t>(index)];
  }
  float& prototype(int index, int x, int y) {
    const int sample = (index * 8 + y) * 16 + x;
    return prototypes_[static_cast<std::size_t>(sample)];
  }

  /// An object whose mask is prototype 0 as it is.
  void put(int anchor, int class_id, float score, cv::Rect2f box) {
    at(0, anchor) = box.x + box.width / 2;
    at(1, anchor) = box.y + box.height / 2;
    at(2, anchor) = box.width;
    at(3, anchor) = box.height;
    at(4 + class_id, anchor) = score;
    at(4 + 3, anchor) = 1.0F;
  }
  void fill_prototype(int index, float value) {
    for (int y = 0; y < 8; ++y) {
      for (int x = 0; x < 16; ++x) prototype(index, x, y) = value;
    }
  }

  [[nodiscard]] YoloSegTensors tensors() const { return {anchors_, prototypes_}; }

 private:
  std::vector<float> anchors_;
  std::vector<float> prototypes_;
};

struct Decoded {
  DecodedInstances instances;
  cv::Mat labels;
};

Expected<DecodedInstances> decode_tensors(const YoloSegLayout& layout,
                                          const YoloSegTensors& tensors,
                                          const Letterbox& letterbox,
                                          const DecoderConfig& config,
                                          cv::Mat& labels) {
  const std::vector<TensorView> outputs{{.floats = tensors.anchors},
                                        {.floats = tensors.prototypes}};
  return YoloSegDecoder(layout, config).decode(outputs, letterbox, labels);
}

Decoded decode(const Network& network,
               const DecoderConfig& config = {},
               cv::Size frame_size = {64, 32}) {
  const Letterbox letterbox = make_letterbox(frame_size, network.layout.input_size);
  const YoloSegTensors tensors = network.tensors();
  Decoded decoded;
  auto result = decode_tensors(network.layout, tensors, letterbox, config, decoded.labels);
  EXPECT_TRUE(result.has_value());
  if (result) decoded.instances = std::move(*result);
  return decoded;
}

Network random_network(unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> unit(0.0F, 1.0F);
  std::normal_distribution<float> normal;
  Network network;
  for (int anchor = 0; anchor < Network::kAnchors; ++anchor) {
    const cv::Rect2f box(70 * unit(random) - 10, 40 * unit(random) - 8, 30 * unit(random),
                         25 * unit(random));
    network.put(anchor, static_cast<int>(3 * unit(random)), unit(random), box);
    for (int i = 0; i < 4; ++i) network.at(4 + 3 + i, anchor) = normal(random);
  }
  for (int i = 0; i < 4; ++i) {
    for (int y = 0; y < 8; ++y) {
      for (int x = 0; x < 16; ++x) network.prototype(i, x, y) = 2 * normal(random);
    }
  }
  return network;
}

// The same decoding written down plainly, pixel by pixel, in double precision.
struct Reference {
  const YoloSegLayout& layout;
  const YoloSegTensors& tensors;
  const Letterbox& letterbox;

  [[nodiscard]] double number(int row, int anchor) const {
    const int index = row * layout.anchors + anchor;
    return tensors.anchors[static_cast<std::size_t>(index)];
  }

  [[nodiscard]] double probability_at_prototype(int anchor, int x, int y) const {
    const cv::Size size = layout.prototype_size;
    double logit = 0.0;
    for (int i = 0; i < layout.coefficients; ++i) {
      const int at = (i * size.height + y) * size.width + x;
      logit += number(4 + layout.classes() + i, anchor) *
               tensors.prototypes[static_cast<std::size_t>(at)];
    }
    return 1.0 / (1.0 + std::exp(-logit));
  }

  /// Probability of an anchor's mask at a frame pixel.
  [[nodiscard]] double probability(int anchor, int x, int y) const {
    const cv::Size size = layout.prototype_size;
    const double u = std::clamp(((x + 0.5) * letterbox.scale_x + letterbox.image.x) / 4 - 0.5, 0.0,
                                size.width - 1.0);
    const double v = std::clamp(((y + 0.5) * letterbox.scale_y + letterbox.image.y) / 4 - 0.5, 0.0,
                                size.height - 1.0);
    const int left = static_cast<int>(u);
    const int top = static_cast<int>(v);
    const int right = std::min(left + 1, size.width - 1);
    const int bottom = std::min(top + 1, size.height - 1);
    const double upper = (1 - (u - left)) * probability_at_prototype(anchor, left, top) +
                         (u - left) * probability_at_prototype(anchor, right, top);
    const double lower = (1 - (u - left)) * probability_at_prototype(anchor, left, bottom) +
                         (u - left) * probability_at_prototype(anchor, right, bottom);
    return (1 - (v - top)) * upper + (v - top) * lower;
  }

  /// True where `labels` is what the detections' masks, the first on top, make of this pixel. A
  /// probability that rounding could move across one half may count either way.
  [[nodiscard]] bool allows(int label,
                            cv::Point pixel,
                            const std::vector<YoloSegDetection>& detections) const {
    for (std::size_t i = 0; i < detections.size(); ++i) {
      const cv::Rect2f box = letterbox.to_frame(detections[i].input_box);
      if (box.empty() || pixel.x < static_cast<int>(box.x) ||
          pixel.x > static_cast<int>(box.br().x) || pixel.y < static_cast<int>(box.y) ||
          pixel.y > static_cast<int>(box.br().y)) {
        continue;
      }
      const double inside = probability(detections[i].anchor, pixel.x, pixel.y);
      const bool is_unsure = std::abs(inside - 0.5) < 1e-5;
      if (label == static_cast<int>(i) + 1 && (inside > 0.5 || is_unsure)) return true;
      if (inside > 0.5 && !is_unsure) return false;
    }
    return label == 0;
  }
};

void expect_equals_reference(unsigned seed, cv::Size frame_size) {
  const Network network = random_network(seed);
  const DecoderConfig config{.score_threshold = 0.3, .nms_iou = 0.5};
  const Decoded decoded = decode(network, config, frame_size);
  const YoloSegTensors tensors = network.tensors();
  const auto detections = find_detections(network.layout, config, tensors);
  ASSERT_TRUE(detections.has_value());
  const Letterbox letterbox = make_letterbox(frame_size, network.layout.input_size);
  const Reference reference{network.layout, tensors, letterbox};
  for (int y = 0; y < frame_size.height; ++y) {
    for (int x = 0; x < frame_size.width; ++x) {
      const int label = decoded.labels.at<std::uint8_t>(y, x);
      ASSERT_TRUE(reference.allows(label, {x, y}, *detections))
          << "seed " << seed << " x " << x << " y " << y << " label " << label;
    }
  }
}

TEST(YoloSegDecoder, EqualsAPlainImplementationOnRandomOutputs) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    expect_equals_reference(seed, {64, 32});   // as is
    expect_equals_reference(seed, {100, 50});  // scaled
    expect_equals_reference(seed, {40, 40});   // scaled, with bars
  }
}

TEST(YoloSegDecoder, ReportsClassScoreAndBoxInFramePixels) {
  Network network;
  network.put(5, 2, 0.75F, {8, 4, 16, 8});
  const Decoded decoded = decode(network, {}, {128, 64});
  ASSERT_EQ(decoded.instances.instances.size(), 1U);
  const Instance& instance = decoded.instances.instances[0];
  EXPECT_EQ(instance.class_name, "tv");
  EXPECT_FLOAT_EQ(instance.score, 0.75F);
  EXPECT_EQ(instance.box, cv::Rect2f(16, 8, 32, 16));
  EXPECT_EQ(instance.motion, MotionVerdict::kUnknown);
}

TEST(YoloSegDecoder, CutsAMaskAtTheBoxWithBothEndsIncluded) {
  Network network;
  network.fill_prototype(0, 10.0F);  // everywhere
  network.put(0, 0, 0.9F, {10, 6, 20, 12});
  const Decoded decoded = decode(network);
  EXPECT_EQ(cv::boundingRect(decoded.labels), cv::Rect(10, 6, 21, 13));
  EXPECT_EQ(cv::countNonZero(decoded.labels), 21 * 13);
}

TEST(YoloSegDecoder, PutsTheHigherScoreOnTopAndFirst) {
  Network network;
  network.fill_prototype(0, 10.0F);
  network.put(3, 0, 0.5F, {0, 0, 40, 30});
  network.put(7, 1, 0.8F, {20, 0, 40, 30});
  const Decoded decoded = decode(network);
  ASSERT_EQ(decoded.instances.instances.size(), 2U);
  EXPECT_EQ(decoded.instances.instances[0].class_name, "chair");
  EXPECT_EQ(decoded.labels.at<std::uint8_t>(10, 30), 1);
  EXPECT_EQ(decoded.labels.at<std::uint8_t>(10, 10), 2);
}

TEST(YoloSegDecoder, DropsLowScoresAndOverlapsOfOneClassOnly) {
  Network network;
  network.put(0, 0, 0.9F, {10, 6, 20, 12});
  network.put(1, 0, 0.8F, {11, 6, 20, 12});  // the same person again
  network.put(2, 1, 0.7F, {10, 6, 20, 12});  // a chair at the same place
  network.put(3, 2, 0.2F, {40, 6, 20, 12});  // below the threshold
  const auto found = find_detections(network.layout, {}, network.tensors());
  ASSERT_TRUE(found.has_value());
  ASSERT_EQ(found->size(), 2U);
  EXPECT_EQ((*found)[0].anchor, 0);
  EXPECT_EQ((*found)[1].anchor, 2);
}

TEST(YoloSegDecoder, KeepsTheBestOfMoreInstancesThanTheMessageHolds) {
  Network network;
  YoloSegLayout& layout = network.layout;
  constexpr std::size_t kMany = 100;
  layout.anchors = kMany;
  std::vector<float> anchors((4 + 3 + 4) * kMany, 0.0F);
  for (std::size_t i = 0; i < kMany; ++i) {
    anchors[i] = static_cast<float>(4 * i);  // side by side
    anchors[2 * kMany + i] = 2.0F;
    anchors[3 * kMany + i] = 2.0F;
    anchors[4 * kMany + i] = 0.3F + 0.005F * static_cast<float>(i);
  }
  const YoloSegTensors tensors{anchors, network.tensors().prototypes};
  cv::Mat labels;
  const auto decoded = decode_tensors(layout, tensors, make_letterbox({64, 32}, layout.input_size),
                                      DecoderConfig{}, labels);
  ASSERT_TRUE(decoded.has_value());
  EXPECT_EQ(decoded->instances.size(), static_cast<std::size_t>(kMaxInstances));
  EXPECT_EQ(decoded->left_out, 100 - kMaxInstances);
  EXPECT_FLOAT_EQ(decoded->instances.front().score, 0.3F + 0.005F * 99);
}

TEST(YoloSegDecoder, EmptiesAReusedLabelImage) {
  const Network nothing_found;
  cv::Mat labels(32, 64, CV_8UC1, cv::Scalar(9));
  const void* memory = labels.data;
  const YoloSegTensors tensors = nothing_found.tensors();
  const Letterbox letterbox = make_letterbox({64, 32}, {64, 32});
  const auto decoded =
      decode_tensors(nothing_found.layout, tensors, letterbox, DecoderConfig{}, labels);
  ASSERT_TRUE(decoded.has_value());
  EXPECT_TRUE(decoded->instances.empty());
  EXPECT_EQ(cv::countNonZero(labels), 0);
  EXPECT_EQ(labels.data, memory);
}

TEST(YoloSegDecoder, WithholdsOutputsThatAreNotNumbers) {
  for (const float poison :
       {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(),
        -std::numeric_limits<float>::infinity()}) {
    Network in_anchors;
    in_anchors.at(5, 17) = poison;
    Network in_prototypes;
    in_prototypes.prototype(2, 3, 4) = poison;
    for (const Network& network : {in_anchors, in_prototypes}) {
      const auto found = find_detections(network.layout, {}, network.tensors());
      ASSERT_FALSE(found.has_value());
      EXPECT_EQ(found.error().code, ExitCode::kInvalidNumber);
      EXPECT_THAT(found.error().message, HasSubstr("NaN"));
    }
  }
}

TEST(YoloSegDecoder, IgnoresBoxesOutsideTheFrameOrWithoutArea) {
  Network network;
  network.fill_prototype(0, 10.0F);
  network.put(0, 0, 0.9F, {200, 6, 20, 12});
  network.put(1, 1, 0.8F, {10, 6, 0, 12});
  network.put(2, 2, 0.7F, {-50, -40, 10, 10});
  const Decoded decoded = decode(network);
  EXPECT_EQ(decoded.instances.instances.size(), 2U);
  EXPECT_EQ(cv::countNonZero(decoded.labels), 0);
}

TEST(DecoderConfig, NamesWhatIsOutOfRange) {
  EXPECT_TRUE(DecoderConfig{}.problems().empty());
  EXPECT_EQ((DecoderConfig{.score_threshold = 1.5, .nms_iou = 0.0}).problems().size(), 2U);
  EXPECT_EQ((DecoderConfig{.score_threshold = std::nan(""), .nms_iou = 0.5}).problems().size(), 1U);
}

}  // namespace
}  // namespace tsg
