#include "services/slam/lib/dynamic/epipolar_coupling.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <vector>

#include "services/slam/lib/dynamic/class_policy.hpp"
#include "services/slam/lib/dynamic/synthetic_pairs.hpp"
#include "services/slam/lib/feature_extractor.hpp"

namespace tsg {
namespace {

constexpr double kNoise = 0.3;  // pixels
const SE3 kNextView = synthetic::pose_at(0.03, 0.015, 0.01, 0.005);
const Eigen::Vector3d kPush(-0.01, 0.03, 0.0);  // metres; across the epipolar lines

synthetic::Body chair(std::size_t count, const Eigen::Vector3d& motion = {0.0, 0.0, 0.0}) {
  synthetic::Body body = synthetic::box_at({-0.3, 0.1, 2.0}, count, 11);
  body.prior = FeatureVerdict::kPotentiallyDynamic;
  body.motion = motion;
  return body;
}

/// Share of features [begin, begin + count) that were found to move.
double dynamic_share(const CouplingVerdicts& verdicts, std::size_t begin, std::size_t count) {
  std::size_t dynamic = 0;
  for (std::size_t i = begin; i < begin + count; ++i) dynamic += verdicts.is_dynamic[i] ? 1 : 0;
  return static_cast<double>(dynamic) / static_cast<double>(count);
}

CouplingVerdicts judge(const synthetic::TwoFrames& frames,
                       DynamicMethod method = DynamicMethod::kTsg) {
  return judge_by_epipolar_lines(frames.reference, frames.current, method, CouplingConfig{});
}

TEST(EpipolarCoupling, KeepsTheChairThatStandsAndDropsTheOneThatIsPushed) {
  synthetic::Body standing = synthetic::box_at({0.5, 0.1, 2.0}, 50, 12);
  standing.prior = FeatureVerdict::kPotentiallyDynamic;
  const auto frames =
      synthetic::observe({synthetic::room(300, 1), standing, chair(50, kPush)}, kNextView, kNoise);
  const CouplingVerdicts verdicts = judge(frames);
  EXPECT_TRUE(verdicts.fundamental);
  EXPECT_GT(verdicts.matches, 380);
  EXPECT_LT(dynamic_share(verdicts, 0, 300), 0.05);
  EXPECT_LT(dynamic_share(verdicts, 300, 50), 0.1);
  EXPECT_GT(dynamic_share(verdicts, 350, 50), 0.95);
}

TEST(EpipolarCoupling, FindsAMovingPatchThatNoMaskCovers) {
  synthetic::Body cart = chair(60, kPush);
  cart.prior = FeatureVerdict::kStatic;
  const auto frames = synthetic::observe({synthetic::room(300, 2), cart}, kNextView, kNoise);
  for (const DynamicMethod method : {DynamicMethod::kTsg, DynamicMethod::kEpipolar}) {
    SCOPED_TRACE(name_of(method));
    const CouplingVerdicts verdicts = judge(frames, method);
    EXPECT_LT(dynamic_share(verdicts, 0, 300), 0.05);
    EXPECT_GT(dynamic_share(verdicts, 300, 60), 0.9);
  }
}

TEST(EpipolarCoupling, IsNotOutvotedByAMoverWithMostOfTheMatchesAsPlainEpipolarLinesAre) {
  const auto frames =
      synthetic::observe({synthetic::room(120, 3), chair(300, kPush)}, kNextView, kNoise);
  const CouplingVerdicts coupled = judge(frames, DynamicMethod::kTsg);
  EXPECT_LT(dynamic_share(coupled, 0, 120), 0.05);
  EXPECT_GT(dynamic_share(coupled, 120, 300), 0.95);
  const CouplingVerdicts plain = judge(frames, DynamicMethod::kEpipolar);
  EXPECT_GT(dynamic_share(plain, 0, 120), 0.5) << "the room is taken for what moves";
  EXPECT_LT(dynamic_share(plain, 120, 300), 0.1) << "and the mover for the room";
}

TEST(EpipolarCoupling, DoesNotSeeWhatMovesAlongItsEpipolarLine) {
  // Camera and chair both go along x: the epipolar lines are rows, and the chair stays on its own.
  const SE3 T_world_sideways = synthetic::pose_at(0.06, 0.0, 0.0);
  const auto frames = synthetic::observe({synthetic::room(300, 4), chair(60, {0.08, 0.0, 0.0})},
                                         T_world_sideways, kNoise);
  EXPECT_LT(dynamic_share(judge(frames), 300, 60), 0.1);
}

TEST(EpipolarCoupling, SeesAllMotionWhileTheCameraStandsStill) {
  for (const Eigen::Vector3d& motion :
       {Eigen::Vector3d(0.02, 0.0, 0.0), Eigen::Vector3d(0.0, 0.02, 0.0), kPush}) {
    const auto frames =
        synthetic::observe({synthetic::room(300, 5), chair(60, motion)}, SE3(), kNoise);
    const CouplingVerdicts verdicts = judge(frames);
    EXPECT_FALSE(verdicts.fundamental);
    EXPECT_LT(dynamic_share(verdicts, 0, 300), 0.05);
    EXPECT_GT(dynamic_share(verdicts, 300, 60), 0.95);
  }
  const auto at_rest = synthetic::observe({synthetic::room(300, 5), chair(60)}, SE3(), kNoise);
  EXPECT_LT(dynamic_share(judge(at_rest), 300, 60), 0.1);
}

TEST(EpipolarCoupling, KeepsOnlyStaticFeaturesOfThoseItCannotTest) {
  synthetic::Body person = chair(30, kPush);
  person.prior = FeatureVerdict::kDynamic;
  auto frames = synthetic::observe({synthetic::room(300, 6), person, chair(30)}, kNextView, kNoise);
  for (Descriptor& descriptor : frames.reference.descriptors) {
    for (std::uint64_t& word : descriptor) word = ~word;  // nothing looks as it did
  }
  const CouplingVerdicts coupled = judge(frames, DynamicMethod::kTsg);
  EXPECT_EQ(coupled.matches, 0);
  EXPECT_FALSE(coupled.fundamental);
  EXPECT_EQ(dynamic_share(coupled, 0, 300), 0.0);
  EXPECT_EQ(dynamic_share(coupled, 300, 60), 1.0);
  for (const float distance : coupled.epipolar_px) EXPECT_LT(distance, 0.0F);
  EXPECT_EQ(dynamic_share(judge(frames, DynamicMethod::kEpipolar), 0, 360), 0.0);
}

TEST(EpipolarCoupling, TestsNothingWithFewerThanEightStaticMatches) {
  const auto frames = synthetic::observe({synthetic::room(7, 7), chair(100)}, kNextView, 0.0);
  const CouplingVerdicts verdicts = judge(frames);
  EXPECT_GT(verdicts.matches, 90);
  EXPECT_FALSE(verdicts.fundamental);
  EXPECT_EQ(dynamic_share(verdicts, 0, 7), 0.0);
  EXPECT_EQ(dynamic_share(verdicts, 7, 100), 1.0);
}

TEST(EpipolarCoupling, TakesAMatchForStaticOnlyIfItWasStaticInBothFrames) {
  auto frames = synthetic::observe({synthetic::room(120, 8), chair(300, kPush)}, kNextView, kNoise);
  for (std::size_t i = 120; i < 420; ++i) {  // a mask that was missing in the reference frame
    frames.reference.items[i].verdict = FeatureVerdict::kStatic;
  }
  const CouplingVerdicts verdicts = judge(frames);
  EXPECT_LT(dynamic_share(verdicts, 0, 120), 0.05);
  EXPECT_GT(dynamic_share(verdicts, 120, 300), 0.95);
}

TEST(EpipolarCoupling, HasOneVerdictForEachFeatureEvenWithoutAny) {
  const CouplingVerdicts verdicts = judge({});
  EXPECT_TRUE(verdicts.is_dynamic.empty());
  EXPECT_TRUE(verdicts.epipolar_px.empty());
  EXPECT_EQ(verdicts.matches, 0);
}

/// Real corners of rendered images, with all that goes wrong with them.
class RenderedFrames : public testing::Test {
 protected:
  RenderedFrames() : extractor_(FeatureConfig{}, synthetic::camera()) {
    scene_.panel(2).label = 1;  // the board in front is a chair
  }

  Features look(std::uint64_t seq, const SE3& T_world_camera) {
    const RgbdFrame frame = scene_.render(seq, T_world_camera);
    const auto mask = scene_.mask(frame, T_world_camera, {"chair"});
    return extractor_.extract(frame, exact_verdicts(mask, DynamicFilterConfig{}));
  }

  /// Share of the features with this prior that were found to move.
  static double dynamic_share_of(const Features& features,
                                 const CouplingVerdicts& verdicts,
                                 FeatureVerdict prior) {
    int all = 0;
    int dynamic = 0;
    for (std::size_t i = 0; i < features.size(); ++i) {
      if (features.items[i].verdict != prior || verdicts.epipolar_px[i] < 0.0F) continue;
      ++all;
      dynamic += verdicts.is_dynamic[i] ? 1 : 0;
    }
    EXPECT_GE(all, 20) << "were tested";
    return static_cast<double>(dynamic) / all;
  }

  synthetic::Scene scene_ = synthetic::Scene::room();
  FeatureExtractor extractor_;
};

TEST_F(RenderedFrames, ShowTheBoardMoveOrStand) {
  const Features reference = look(0, SE3());
  const SE3 T_world_current = synthetic::pose_at(0.05, 0.0, 0.0, 0.005);
  const Features at_rest = look(1, T_world_current);
  const auto kept =
      judge_by_epipolar_lines(reference, at_rest, DynamicMethod::kTsg, CouplingConfig{});
  EXPECT_LT(dynamic_share_of(at_rest, kept, FeatureVerdict::kStatic), 0.25);
  EXPECT_LT(dynamic_share_of(at_rest, kept, FeatureVerdict::kPotentiallyDynamic), 0.25);

  scene_.panel(2).corner.y() += 0.025;  // 8 pixels down
  const Features pushed = look(1, T_world_current);
  const auto dropped =
      judge_by_epipolar_lines(reference, pushed, DynamicMethod::kTsg, CouplingConfig{});
  EXPECT_LT(dynamic_share_of(pushed, dropped, FeatureVerdict::kStatic), 0.25);
  EXPECT_GT(dynamic_share_of(pushed, dropped, FeatureVerdict::kPotentiallyDynamic), 0.9);
}

}  // namespace
}  // namespace tsg
