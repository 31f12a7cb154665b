#include "services/slam/dense_keyframes.hpp"

#include <gtest/gtest.h>

namespace tsg {
namespace {

constexpr std::int64_t kFrameNs = 33'333'333;
constexpr std::int64_t kPatienceNs = 10 * kFrameNs;

RgbdFrame frame_number(std::uint64_t seq) {
  RgbdFrame frame;
  frame.seq = seq;
  frame.stamp_ns = static_cast<std::int64_t>(seq) * kFrameNs;
  frame.colour = cv::Mat(4, 6, CV_8UC3, cv::Scalar::all(static_cast<double>(seq)));
  frame.depth = cv::Mat(4, 6, CV_16UC1, cv::Scalar::all(static_cast<double>(seq)));
  return frame;
}

InstanceSegmentation mask_of(std::uint64_t seq) {
  InstanceSegmentation mask;
  mask.frame_seq = seq;
  mask.labels = cv::Mat::zeros(4, 6, CV_8UC1);
  return mask;
}

TEST(DenseKeyframes, SendsAKeyframeAtOnceWithItsOwnMask) {
  DenseKeyframes keyframes(true, kPatienceNs);
  const InstanceSegmentation mask = mask_of(3);
  const auto sent = keyframes.add_frame(frame_number(3), KeyframePlace{}, true, &mask);
  ASSERT_TRUE(sent);
  EXPECT_EQ(sent->frame.seq, 3U);
  EXPECT_TRUE(sent->segmentation);
}

TEST(DenseKeyframes, SendsAKeyframeAtOnceWhereNobodySegments) {
  DenseKeyframes keyframes(false, kPatienceNs);
  const auto sent = keyframes.add_frame(frame_number(3), KeyframePlace{}, true, nullptr);
  ASSERT_TRUE(sent);
  EXPECT_FALSE(sent->segmentation);
  EXPECT_EQ(keyframes.without_mask(), 0U);
}

TEST(DenseKeyframes, LeavesOtherFramesAlone) {
  DenseKeyframes keyframes(true, kPatienceNs);
  const InstanceSegmentation mask = mask_of(3);
  EXPECT_FALSE(keyframes.add_frame(frame_number(3), KeyframePlace{}, false, &mask));
  EXPECT_FALSE(keyframes.add_mask(mask_of(3)));
}

TEST(DenseKeyframes, SendsTheFrameThatALateMaskBelongsTo) {
  DenseKeyframes keyframes(true, kPatienceNs);
  EXPECT_FALSE(keyframes.add_frame(frame_number(3), KeyframePlace{}, true, nullptr));
  {
    RgbdFrame gone = frame_number(4);  // its pixels must have been copied
    const SE3 T_map_camera(Eigen::Quaterniond::Identity(), Eigen::Vector3d(4.0, 0.0, 0.0));
    EXPECT_FALSE(keyframes.add_frame(gone, {.T_map_camera = T_map_camera}, false, nullptr));
    gone.colour.setTo(0);
    gone.depth.setTo(0);
  }
  EXPECT_FALSE(keyframes.add_frame(frame_number(5), KeyframePlace{}, false, nullptr));
  EXPECT_FALSE(keyframes.add_mask(mask_of(2)));
  const auto sent = keyframes.add_mask(mask_of(4));
  ASSERT_TRUE(sent);
  EXPECT_EQ(sent->frame.seq, 4U);
  EXPECT_EQ(sent->frame.depth.at<std::uint16_t>(2, 2), 4);
  EXPECT_EQ(sent->frame.colour.at<cv::Vec3b>(2, 2)[0], 4);
  EXPECT_EQ(sent->place.T_map_camera.translation().x(), 4.0);
  EXPECT_FALSE(keyframes.add_mask(mask_of(5))) << "one frame for each keyframe";
}

TEST(DenseKeyframes, SendsTheKeyframeUnlabelledWhenNoMaskComesInTime) {
  DenseKeyframes keyframes(true, kPatienceNs);
  std::optional<DenseKeyframe> sent;
  std::uint64_t seq = 3;
  for (; !sent && seq < 100; ++seq) {
    sent = keyframes.add_frame(frame_number(seq), KeyframePlace{}, seq == 3, nullptr);
  }
  ASSERT_TRUE(sent);
  EXPECT_EQ(seq, 3U + 10U + 1U);
  EXPECT_EQ(sent->frame.seq, 3U);
  EXPECT_FALSE(sent->segmentation);
  EXPECT_EQ(keyframes.without_mask(), 1U);
}

TEST(DenseKeyframes, FlushSendsWhatStillWaits) {
  DenseKeyframes keyframes(true, kPatienceNs);
  EXPECT_FALSE(keyframes.flush());
  EXPECT_FALSE(keyframes.add_frame(frame_number(3), KeyframePlace{}, true, nullptr));
  const auto sent = keyframes.flush();
  ASSERT_TRUE(sent);
  EXPECT_EQ(sent->frame.seq, 3U);
  EXPECT_FALSE(keyframes.flush());
}

}  // namespace
}  // namespace tsg
