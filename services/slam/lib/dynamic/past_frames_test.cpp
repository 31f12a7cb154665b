#include "services/slam/lib/dynamic/past_frames.hpp"

#include <gtest/gtest.h>

namespace tsg {
namespace {

constexpr std::int64_t kMs = 1'000'000;

/// Frames `first` to `last` with features and a pose.
void add_frames(PastFrames& past, std::uint64_t first, std::uint64_t last, std::int64_t period_ns) {
  for (std::uint64_t seq = first; seq <= last; ++seq) {
    past.add({.seq = seq,
              .stamp_ns = static_cast<std::int64_t>(seq) * period_ns,
              .depth = {},
              .features = std::make_shared<const Features>(),
              .T_world_camera = SE3()});
  }
}

TEST(PastFrames, KnowsTheOneBefore) {
  PastFrames past;
  add_frames(past, 7, 7, 100 * kMs);
  EXPECT_EQ(past.previous(), nullptr);
  add_frames(past, 8, 8, 100 * kMs);
  ASSERT_NE(past.previous(), nullptr);
  EXPECT_EQ(past.previous()->seq, 7U);
  EXPECT_EQ(past.now().seq, 8U);
}

TEST(PastFrames, FindsTheLatestOldEnoughThatHasAPose) {
  PastFrames past;
  add_frames(past, 0, 10, 100 * kMs);
  ASSERT_NE(past.before(250 * kMs), nullptr);
  EXPECT_EQ(past.before(250 * kMs)->seq, 7U);
  EXPECT_EQ(past.before(300 * kMs)->seq, 7U);
  past.find(7)->T_world_camera.reset();
  EXPECT_EQ(past.before(300 * kMs)->seq, 6U);
  EXPECT_EQ(past.before(1100 * kMs), nullptr);  // there is none
  past.forget_poses();
  EXPECT_EQ(past.before(300 * kMs), nullptr);
}

TEST(PastFrames, FindsNoneThatIsMoreThanTwiceAsOld) {
  PastFrames past;
  add_frames(past, 0, 0, 100 * kMs);
  past.add({.seq = 1, .stamp_ns = 400 * kMs, .depth = {}});
  EXPECT_EQ(past.before(200 * kMs), nullptr);
  ASSERT_NE(past.before(201 * kMs), nullptr);
  EXPECT_EQ(past.before(201 * kMs)->seq, 0U);
}

TEST(PastFrames, BeginsAnewWhenStampsGoBack) {
  PastFrames past;
  add_frames(past, 10, 20, 100 * kMs);
  add_frames(past, 3, 3, 100 * kMs);
  EXPECT_EQ(past.now().seq, 3U);
  EXPECT_EQ(past.previous(), nullptr);
  EXPECT_EQ(past.find(20), nullptr);
}

TEST(PastFrames, ForgetsWhatIsLongAgoAndThinsTheRest) {
  PastFrames past;
  add_frames(past, 0, 300, 33 * kMs);
  EXPECT_EQ(past.find(300 - 80), nullptr);  // 2.64 s ago
  EXPECT_NE(past.find(300 - 76), nullptr);
  EXPECT_EQ(past.find(300 - 75), nullptr);
  EXPECT_EQ(past.find(300 - 76)->features, nullptr);
  for (std::uint64_t age = 0; age < 32; ++age) {
    ASSERT_NE(past.find(300 - age), nullptr) << age;
    EXPECT_NE(past.find(300 - age)->features, nullptr) << age;
  }
}

TEST(PastFrames, MovesPosesWithTheWorld) {
  PastFrames past;
  add_frames(past, 0, 1, 100 * kMs);
  past.now().T_world_camera.reset();
  past.move_world({Eigen::Quaterniond::Identity(), Eigen::Vector3d(1.0, 2.0, 3.0)});
  EXPECT_EQ(past.find(0)->T_world_camera->translation(), Eigen::Vector3d(1.0, 2.0, 3.0));
  EXPECT_FALSE(past.now().T_world_camera.has_value());
}

}  // namespace
}  // namespace tsg
