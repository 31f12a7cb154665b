#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "common/bus/command.hpp"
#include "common/dataset/trajectory.hpp"
#include "tests/component/slam_service.hpp"
#include "tests/support/stop_limit.hpp"
#include "tests/support/wait.hpp"

namespace tsg::test {
namespace {

using namespace std::chrono_literals;
using ::testing::HasSubstr;

TEST_F(SlamService, PublishesThePoseOfEveryFrame) {
  start({"slam.lockstep=true", "slam.expect_masks=false"});
  auto& poses = bus_.subscriber<topics::Pose>();
  auto& odometry = bus_.subscriber<topics::Odometry>();
  ASSERT_TRUE(poses.wait_for_publishers(1, kPatience)) << content_of(log_);
  ASSERT_TRUE(odometry.wait_for_publishers(1, kPatience));
  for (std::uint64_t seq = 0; seq < 10; ++seq) {
    const double x_m = 0.02 * static_cast<double>(seq);
    ASSERT_EQ(track(wall_.frame(seq, x_m, 0.0)), tsg_TRACKING_OK) << content_of(log_);
    const auto pose = poses.take({}, kPatience);
    const auto odom = odometry.take({}, kPatience);
    ASSERT_TRUE(pose && odom);
    EXPECT_STREQ((*pose)->header.frame_id, "map");
    EXPECT_STREQ((*odom)->header.frame_id, "odom");
    EXPECT_STREQ((*odom)->child_frame_id, "camera");
    EXPECT_EQ(to_ns((*pose)->header.stamp), wall_.frame(seq, 0.0, 0.0).stamp_ns);
    EXPECT_NEAR((*pose)->pose.position.y, -x_m, 0.004) << "right of the camera is -y of the map";
    EXPECT_NEAR((*pose)->pose.position.z, 0.0, 0.004);
    EXPECT_NEAR((*odom)->pose.pose.position.y, -x_m, 0.004);
    const double variance = (*odom)->pose.covariance[7];  // of y
    EXPECT_EQ(variance > 0.0, seq > 0) << "the first frame is where the world begins";
    EXPECT_LT(variance, 0.005 * 0.005);
  }
  EXPECT_TRUE(stop().is_success()) << content_of(log_);
}

TEST_F(SlamService, PublishesTransformsFromMapOverOdomToCamera) {
  start({"slam.lockstep=true", "slam.expect_masks=false"});
  ASSERT_TRUE(bus_.watch<topics::Transforms>(kPatience)) << content_of(log_);
  ASSERT_EQ(track(wall_.frame(0, 0.0, 0.0)), tsg_TRACKING_OK);
  const auto transforms = bus_.subscriber<topics::Transforms>().take({}, kPatience);
  ASSERT_TRUE(transforms);
  ASSERT_EQ((*transforms)->transforms._length, 2U);
  const auto* parts = (*transforms)->transforms._buffer;
  EXPECT_STREQ(parts[0].header.frame_id, "map");
  EXPECT_STREQ(parts[0].child_frame_id, "odom");
  EXPECT_STREQ(parts[1].header.frame_id, "odom");
  EXPECT_STREQ(parts[1].child_frame_id, "camera");
}

TEST_F(SlamService, SendsAKeyframeThroughSharedMemoryWithoutACopy) {
  start({"slam.lockstep=true", "slam.expect_masks=false"});
  ASSERT_TRUE(bus_.watch<topics::Keyframe>(kPatience)) << content_of(log_);
  ASSERT_EQ(track(wall_.frame(7, 0.0, 0.0)), tsg_TRACKING_OK);
  const auto keyframe = bus_.subscriber<topics::Keyframe>().take({}, kPatience);
  ASSERT_TRUE(keyframe);
  EXPECT_TRUE(keyframe->is_zero_copy());
  EXPECT_EQ((*keyframe)->frame_seq, 7U);
  EXPECT_FALSE((*keyframe)->has_labels);
  EXPECT_EQ((*keyframe)->depth[0], 10000);
}

TEST_F(SlamService, SendsTheKeyframeWithTheMaskOfItsOwnFrame) {
  start({"slam.expect_masks=true", "slam.keyframe_mask_wait_s=10"});
  ASSERT_TRUE(bus_.watch<topics::Keyframe>(kPatience)) << content_of(log_);
  ASSERT_EQ(track(wall_.frame(0, 0.0, 0.0)), tsg_TRACKING_OK);
  ASSERT_EQ(track(wall_.frame(1, 0.0, 0.0)), tsg_TRACKING_OK);
  ASSERT_TRUE(bus_.publish<topics::Instances>([&](tsg_InstanceMask& message) {
    InstanceSegmentation mask;
    mask.frame_seq = 1;
    mask.stamp_ns = wall_.frame(1, 0.0, 0.0).stamp_ns;
    mask.labels = cv::Mat::zeros(480, 640, CV_8UC1);
    mask.labels(cv::Rect(0, 0, 100, 100)) = 1;
    mask.instances.push_back(
        {.class_name = "person", .score = 1.0F, .box = cv::Rect2f(0.0F, 0.0F, 100.0F, 100.0F)});
    ASSERT_TRUE(fill_message(mask, message));
  }));
  std::uint64_t seq = 2;
  std::optional<Sample<topics::Keyframe>> keyframe;
  for (; !keyframe && seq < 100; ++seq) {
    ASSERT_EQ(track(wall_.frame(seq, 0.0, 0.0)), tsg_TRACKING_OK);
    keyframe = bus_.subscriber<topics::Keyframe>().take({}, 50ms);
  }
  ASSERT_TRUE(keyframe);
  EXPECT_EQ((*keyframe)->frame_seq, 1U);
  EXPECT_TRUE((*keyframe)->has_labels);
  EXPECT_EQ((*keyframe)->instance_count, 1U);
  EXPECT_STREQ((*keyframe)->instances[0].class_name, "person");
}

TEST_F(SlamService, SaysWhyThereIsNoPoseAndPublishesNone) {
  start({"slam.lockstep=true", "slam.expect_masks=false"});
  ASSERT_TRUE(bus_.watch<topics::Pose>(kPatience)) << content_of(log_);
  ASSERT_EQ(track(wall_.frame(0, 0.0, 0.0)), tsg_TRACKING_OK);
  ASSERT_TRUE(bus_.subscriber<topics::Pose>().take({}, kPatience));
  RgbdFrame covered = wall_.frame(1, 0.0, 0.0);
  covered.colour.setTo(0);
  covered.depth.setTo(0);
  send(covered);
  const auto status = status_of(1);
  ASSERT_TRUE(status);
  EXPECT_EQ((*status)->state, tsg_TRACKING_LOST);
  EXPECT_STRNE((*status)->reason, "");
  EXPECT_FALSE(bus_.subscriber<topics::Pose>().take({}, 100ms));
  EXPECT_EQ(track(wall_.frame(2, 0.0, 0.0)), tsg_TRACKING_OK) << "the view is back";
}

TEST_F(SlamService, CarriedElsewhereItGoesOnInAFrameOfItsOwnUntilItIsBack) {
  start({"slam.lockstep=true", "slam.expect_masks=false", "slam.tracker.new_part_after_s=0.5"});
  ASSERT_TRUE(bus_.watch<topics::Pose>(kPatience)) << content_of(log_);
  auto& poses = bus_.subscriber<topics::Pose>();
  std::uint64_t seq = 0;
  const auto step = [&](const TexturedWall& wall, double x_m, double y_m) {
    EXPECT_EQ(track(wall.frame(seq++, x_m, y_m)), tsg_TRACKING_OK) << content_of(log_);
    const auto pose = poses.take({}, kPatience);
    return pose ? std::string((*pose)->header.frame_id) : "no pose";
  };
  // Up and down: the wall is not wide enough for the ten keyframes of a map worth keeping.
  for (int i = 0; i < 90; ++i) {
    const double turn = 0.2 * i;
    EXPECT_EQ(step(wall_, 0.02 * i - 0.9, 0.5 * std::sin(turn)), "map");
  }
  const TexturedWall elsewhere(2.0, 77);
  EXPECT_EQ(track(elsewhere.frame(seq++, 0.0, 0.0)), tsg_TRACKING_LOST);
  seq += 20;
  const std::string own_frame = step(elsewhere, 0.0, 0.0);
  EXPECT_THAT(own_frame, testing::StartsWith("map_"));
  send(elsewhere.frame(seq, 0.02, 0.0));
  const auto status = status_of(seq++);
  ASSERT_TRUE(status);
  EXPECT_EQ((*status)->state, tsg_TRACKING_OK);
  EXPECT_THAT((*status)->reason, HasSubstr("not been joined"));
  const auto pose = poses.take({}, kPatience);
  ASSERT_TRUE(pose);
  EXPECT_EQ((*pose)->header.frame_id, own_frame);
  EXPECT_EQ(track(wall_.frame(seq++, 0.0, 0.0)), tsg_TRACKING_LOST) << "it is recalled first";
  EXPECT_EQ(step(wall_, 0.0, 0.0), "map");
}

TEST_F(SlamService, RejectsAFrameThatMakesNoSenseAndLivesOn) {
  start({"slam.lockstep=true", "slam.expect_masks=false"});
  ASSERT_EQ(track(wall_.frame(0, 0.0, 0.0)), tsg_TRACKING_OK) << content_of(log_);
  auto loan = bus_.publisher<topics::Rgbd>().loan();
  ASSERT_TRUE(loan);
  ASSERT_TRUE(fill_message(wall_.frame(1, 0.0, 0.0), **loan));
  (*loan)->intrinsics.width = 100'000;
  ASSERT_TRUE(bus_.publisher<topics::Rgbd>().publish(std::move(*loan)));
  const auto status = status_of(1);
  ASSERT_TRUE(status);
  EXPECT_THAT((*status)->reason, HasSubstr("frame rejected"));
  RgbdFrame smaller = wall_.frame(2, 0.0, 0.0);
  smaller.camera.width = 320;
  smaller.camera.cx = 159.5;
  smaller.colour = smaller.colour(cv::Rect(0, 0, 320, 480)).clone();
  smaller.depth = smaller.depth(cv::Rect(0, 0, 320, 480)).clone();
  send(smaller);
  const auto other_camera = status_of(2);
  ASSERT_TRUE(other_camera);
  EXPECT_THAT((*other_camera)->reason, HasSubstr("size or intrinsics changed"));
  EXPECT_EQ(track(wall_.frame(1, 0.0, 0.0)), tsg_TRACKING_OK);
  EXPECT_EQ(track(wall_.frame(1, 0.0, 0.0)), tsg_TRACKING_LOST) << "the same stamp again";
}

TEST_F(SlamService, GetsTheFirstFrameThatIsSentOnceItHasStartedAnew) {
  for (std::uint64_t seq = 0; seq < 6; ++seq) {
    start({"slam.lockstep=true", "slam.expect_masks=false"});
    static_cast<void>(bus_.subscriber<topics::TrackingStatus>());
    send(wall_.frame(seq, 0.0, 0.0));
    const auto status = bus_.wait_for<topics::TrackingStatus>(
        kPatience, [seq](const auto& answer) { return answer.header.seq == seq; });
    EXPECT_TRUE(status) << "start " << seq << "\n" << content_of(log_);
    ASSERT_TRUE(stop().is_success()) << content_of(log_);
    ASSERT_TRUE(eventually(kPatience,
                           [&] { return bus_.publisher<topics::Rgbd>().subscriber_count() == 0; }));
  }
}

TEST_F(SlamService, TellsWhoComesLaterHowItStands) {
  start({"slam.lockstep=true", "slam.expect_masks=false"});
  ASSERT_EQ(track(wall_.frame(0, 0.0, 0.0)), tsg_TRACKING_OK) << content_of(log_);
  ASSERT_EQ(track(wall_.frame(1, 0.01, 0.0)), tsg_TRACKING_OK) << content_of(log_);
  Subscriber<topics::TrackingStatus> late(bus_.bus());
  // A sample that somebody has not acknowledged yet may still be kept; the last one comes for sure.
  auto status = late.take({}, kPatience);
  while (status && (*status)->header.seq == 0) {
    status = late.take({}, kPatience);
  }
  ASSERT_TRUE(status);
  EXPECT_EQ((*status)->header.seq, 1U);
}

TEST_F(SlamService, SavesTheTrajectoryOnCommand) {
  start({"slam.lockstep=true", "slam.expect_masks=false"});
  for (std::uint64_t seq = 0; seq < 5; ++seq) {
    ASSERT_EQ(track(wall_.frame(seq, 0.0, 0.0)), tsg_TRACKING_OK) << content_of(log_);
  }
  CommandClient client(bus_.bus());
  const std::string argument = nlohmann::json{{"folder", (folder_ / "out").string()}}.dump();
  const auto reply = client.call("slam", "save_trajectory", argument, kPatience);
  ASSERT_TRUE(reply) << reply.error().message;
  EXPECT_EQ(nlohmann::json::parse(*reply)["frames_tracked"], 5);
  for (const char* name : {"trajectory.txt", "trajectory_live.txt"}) {
    const auto trajectory = read_trajectory(folder_ / "out" / name);
    ASSERT_TRUE(trajectory) << trajectory.error().message;
    EXPECT_EQ(trajectory->size(), 5U);
    EXPECT_EQ(trajectory->front().stamp_ns, TexturedWall::kStartNs);
  }
  EXPECT_TRUE(read_trajectory(folder_ / "out" / "keyframes.txt"));
}

TEST_F(SlamService, AnswersThatThereIsNothingToSaveBeforeTheFirstPose) {
  start({});
  CommandClient client(bus_.bus());
  const auto reply = client.call("slam", "save_trajectory", R"({"folder": "/tmp"})", kPatience);
  ASSERT_FALSE(reply);
  EXPECT_EQ(reply.error().code, ExitCode::kEmptyInput);
  const auto without = client.call("slam", "save_trajectory", "{}", kPatience);
  ASSERT_FALSE(without);
  EXPECT_EQ(without.error().code, ExitCode::kUsage);
}

TEST_F(SlamService, EndsWhereLockstepWaitsInVainForAMask) {
  start({"slam.lockstep=true", "slam.lockstep_mask_wait_s=0.2"});
  const auto ended = end_of(wall_.frame(0, 0.0, 0.0));
  ASSERT_TRUE(ended);
  EXPECT_EQ(ended->exit_code, static_cast<int>(ExitCode::kTimeout));
  EXPECT_THAT(content_of(log_), HasSubstr("no mask of frame 0"));
}

TEST_F(SlamService, EndsWithinTwoSecondsOfSigterm) {
  start({});
  ASSERT_EQ(track(wall_.frame(0, 0.0, 0.0)), tsg_TRACKING_OK) << content_of(log_);
  const auto asked = std::chrono::steady_clock::now();
  EXPECT_TRUE(stop().is_success()) << content_of(log_);
  EXPECT_LT(std::chrono::steady_clock::now() - asked, kStopLimit);
}

TEST_F(SlamService, RefusesAKeyThatNobodyReads) {
  start({"slam.tracker.typo=1"});
  const auto ended = process_->wait(kPatience);
  ASSERT_TRUE(ended);
  EXPECT_EQ(ended->exit_code, static_cast<int>(ExitCode::kConfig));
  EXPECT_THAT(content_of(log_), HasSubstr("unknown key slam.tracker.typo"));
}

}  // namespace
}  // namespace tsg::test
