#include "common/bus/convert.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <memory>
#include <opencv2/core.hpp>

namespace tsg {
namespace {

using ::testing::HasSubstr;

RgbdFrame small_frame() {
  RgbdFrame frame;
  frame.seq = 7;
  frame.stamp_ns = 1'305'031'102'175'304'000;
  frame.camera = {.width = 4, .height = 3, .fx = 5.0, .fy = 6.0, .cx = 1.5, .cy = 1.0};
  frame.camera.distortion = {0.1, 0.2, 0.3, 0.4, 0.5};
  frame.depth_units_per_metre = 5000.0;
  frame.colour.create(3, 4, CV_8UC3);
  frame.depth.create(3, 4, CV_16UC1);
  cv::randu(frame.colour, 0, 255);
  cv::randu(frame.depth, 0, 65535);
  return frame;
}

InstanceSegmentation small_segmentation() {
  InstanceSegmentation segmentation{.frame_seq = 7, .stamp_ns = 42, .labels = {}, .instances = {}};
  segmentation.labels = (cv::Mat_<std::uint8_t>(3, 4) << 0, 1, 2, 0, 1, 1, 2, 2, 0, 0, 0, 0);
  segmentation.instances = {{.class_name = "person",
                             .score = 0.5F,
                             .box = {1, 2, 3, 4},
                             .motion = MotionVerdict::kMoving,
                             .track_id = 41},
                            {.class_name = "potted plant", .score = 1.0F, .box = {0, 0, 2, 2}}};
  return segmentation;
}

bool are_equal(const cv::Mat& a, const cv::Mat& b) { return cv::norm(a, b, cv::NORM_INF) == 0.0; }

TEST(ConvertFrame, ComesBackAsItWasWithoutACopy) {
  const auto message = std::make_unique<tsg_RgbdFrame>();
  const RgbdFrame frame = small_frame();
  ASSERT_TRUE(fill_message(frame, *message));
  const auto view = view_as_frame(*message);
  ASSERT_TRUE(view);
  EXPECT_EQ(view->seq, frame.seq);
  EXPECT_EQ(view->stamp_ns, frame.stamp_ns);
  EXPECT_EQ(view->camera, frame.camera);
  EXPECT_EQ(view->depth_units_per_metre, frame.depth_units_per_metre);
  EXPECT_TRUE(are_equal(view->colour, frame.colour));
  EXPECT_TRUE(are_equal(view->depth, frame.depth));
  EXPECT_EQ(view->colour.data, message->colour);
  EXPECT_EQ(view->depth.data, reinterpret_cast<const std::uint8_t*>(message->depth));
  EXPECT_GT(message->header.publish_monotonic_ns, 0);
}

TEST(ConvertFrame, TakesPartOfALargerImage) {
  const auto message = std::make_unique<tsg_RgbdFrame>();
  RgbdFrame frame = small_frame();
  const cv::Mat large(10, 10, CV_8UC3, cv::Scalar(1, 2, 3));
  frame.colour = large(cv::Rect(3, 3, 4, 3));  // rows are not contiguous
  ASSERT_TRUE(fill_message(frame, *message));
  EXPECT_TRUE(are_equal(view_as_frame(*message)->colour, frame.colour));
}

TEST(ConvertFrame, RejectsDepthOfAnotherSize) {
  const auto message = std::make_unique<tsg_RgbdFrame>();
  RgbdFrame frame = small_frame();
  frame.depth = cv::Mat::zeros(2, 4, CV_16UC1);
  const auto filled = fill_message(frame, *message);
  ASSERT_FALSE(filled);
  EXPECT_EQ(filled.error().code, ExitCode::kSizeMismatch);
  EXPECT_THAT(filled.error().message, HasSubstr("4x2"));
}

TEST(ConvertFrame, RejectsImagesLargerThanTheWireType) {
  const auto message = std::make_unique<tsg_RgbdFrame>();
  RgbdFrame frame = small_frame();
  frame.camera.width = 1920;
  frame.camera.height = 1080;
  frame.colour = cv::Mat::zeros(1080, 1920, CV_8UC3);
  frame.depth = cv::Mat::zeros(1080, 1920, CV_16UC1);
  const auto filled = fill_message(frame, *message);
  ASSERT_FALSE(filled);
  EXPECT_EQ(filled.error().code, ExitCode::kSizeMismatch);
  EXPECT_THAT(filled.error().message, HasSubstr("1920x1080"));
}

TEST(ConvertFrame, RejectsAMessageWithImpossibleSize) {
  const auto message = std::make_unique<tsg_RgbdFrame>();
  ASSERT_TRUE(fill_message(small_frame(), *message));
  message->intrinsics.width = 4'000'000'000U;
  EXPECT_EQ(view_as_frame(*message).error().code, ExitCode::kBadData);
  message->intrinsics.width = 0;
  EXPECT_EQ(view_as_frame(*message).error().code, ExitCode::kBadData);
}

TEST(ConvertFrame, RejectsAMessageWithoutDepthScale) {
  const auto message = std::make_unique<tsg_RgbdFrame>();
  ASSERT_TRUE(fill_message(small_frame(), *message));
  message->depth_units_per_metre = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(view_as_frame(*message).error().code, ExitCode::kBadData);
}

TEST(ConvertInstances, ComeBackAsTheyWere) {
  const auto message = std::make_unique<tsg_InstanceMask>();
  const InstanceSegmentation sent = small_segmentation();
  ASSERT_TRUE(fill_message(sent, *message));
  const auto view = view_as_instances(*message);
  ASSERT_TRUE(view);
  EXPECT_EQ(view->frame_seq, 7U);
  EXPECT_EQ(view->stamp_ns, 42);
  EXPECT_TRUE(are_equal(view->labels, sent.labels));
  ASSERT_EQ(view->instances.size(), 2U);
  EXPECT_EQ(view->instances[0].class_name, "person");
  EXPECT_EQ(view->instances[0].box, sent.instances[0].box);
  EXPECT_EQ(view->instances[0].motion, MotionVerdict::kMoving);
  EXPECT_EQ(view->instances[0].track_id, 41U);
  EXPECT_EQ(view->instances[1].track_id, 0U);
  EXPECT_EQ(view->instances[1].class_name, "potted plant");
  EXPECT_EQ(view->instances[1].motion, MotionVerdict::kUnknown);
}

TEST(ConvertInstances, RejectsALabelWithoutInstance) {
  const auto message = std::make_unique<tsg_InstanceMask>();
  ASSERT_TRUE(fill_message(small_segmentation(), *message));
  message->instance_count = 1;
  EXPECT_EQ(view_as_instances(*message).error().code, ExitCode::kBadData);
  message->instance_count = 65;
  EXPECT_EQ(view_as_instances(*message).error().code, ExitCode::kBadData);
}

TEST(ConvertInstances, RejectsTooManyInstancesAndTooLongNames) {
  const auto message = std::make_unique<tsg_InstanceMask>();
  InstanceSegmentation segmentation = small_segmentation();
  segmentation.instances[0].class_name = std::string(32, 'x');
  EXPECT_EQ(fill_message(segmentation, *message).error().code, ExitCode::kBadData);
  segmentation.instances.assign(65, Instance{});
  EXPECT_EQ(fill_message(segmentation, *message).error().code, ExitCode::kBadData);
}

TEST(ConvertKeyframe, CarriesFrameAndLabels) {
  const auto message = std::make_unique<tsg_Keyframe>();
  const RgbdFrame frame = small_frame();
  ASSERT_TRUE(fill_message(frame, *message));
  EXPECT_FALSE(message->has_labels);
  EXPECT_TRUE(view_as_instances(*message)->labels.empty());

  ASSERT_TRUE(fill_message(small_segmentation(), *message));
  EXPECT_TRUE(message->has_labels);
  const auto frame_view = view_as_frame(*message);
  ASSERT_TRUE(frame_view);
  EXPECT_EQ(frame_view->seq, frame.seq);
  EXPECT_TRUE(are_equal(frame_view->depth, frame.depth));
  const auto labels_view = view_as_instances(*message);
  ASSERT_TRUE(labels_view);
  EXPECT_TRUE(are_equal(labels_view->labels, small_segmentation().labels));
  EXPECT_EQ(labels_view->instances.size(), 2U);
}

TEST(ConvertKeyframe, RejectsLabelsOfAnotherSize) {
  const auto message = std::make_unique<tsg_Keyframe>();
  ASSERT_TRUE(fill_message(small_frame(), *message));
  InstanceSegmentation segmentation = small_segmentation();
  segmentation.labels = cv::Mat::zeros(4, 4, CV_8UC1);
  EXPECT_EQ(fill_message(segmentation, *message).error().code, ExitCode::kSizeMismatch);
}

TEST(ConvertPose, ComesBackAsItWas) {
  const SE3 T_a_b = SE3::exp((Vector6d() << 1.0, -2.0, 3.0, 0.4, -0.5, 0.6).finished());
  const auto back = to_se3(to_message(T_a_b));
  ASSERT_TRUE(back);
  EXPECT_LT((back->inverse() * T_a_b).log().norm(), 1e-12);
}

TEST(ConvertPose, RejectsWhatIsNoRigidTransform) {
  tsg_Pose pose = to_message(SE3());
  pose.ty = std::numeric_limits<double>::infinity();
  EXPECT_EQ(to_se3(pose).error().code, ExitCode::kInvalidNumber);
  EXPECT_EQ(to_se3(tsg_Pose{}).error().code, ExitCode::kInvalidNumber);  // quaternion of zeros
}

TEST(ConvertTime, ComesBackAsItWasBeforeAndAfter1970) {
  for (const std::int64_t stamp_ns :
       std::array<std::int64_t, 4>{1'305'031'102'175'304'001, 0, -1, -1'500'000'000}) {
    const auto time = to_ros_time(stamp_ns);
    EXPECT_LT(time.nanosec, 1'000'000'000U);
    EXPECT_EQ(to_ns(time), stamp_ns);
  }
}

}  // namespace
}  // namespace tsg
