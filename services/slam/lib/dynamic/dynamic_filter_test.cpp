#include "services/slam/lib/dynamic/dynamic_filter.hpp"

#include <gtest/gtest.h>

#include <array>
#include <memory>

#include "services/slam/lib/dynamic/class_policy.hpp"
#include "services/slam/lib/feature_extractor.hpp"
#include "services/slam/lib/synthetic_scene.hpp"

namespace tsg {
namespace {

constexpr double kWalkingSpeed = 1.0;  // m/s along x

/// A person-sized board that walks in front of a wall.
synthetic::Panel walker(double x) {
  return {.z = 2.0, .corner = {x, -0.8}, .extent = {0.5, 1.6}, .texture_seed = 9, .label = 1};
}

class DynamicFilterTest : public testing::Test {
 protected:
  DynamicFilterTest()
      : scene_({{.z = 3.0, .corner = {-4.0, -3.0}, .extent = {8.0, 6.0}, .texture_seed = 1},
                walker(-0.5)}) {}

  RgbdFrame render(std::uint64_t seq) {
    const double seconds = static_cast<double>(seq) / 30.0;
    scene_.panel(1) = walker(-0.5 + kWalkingSpeed * seconds);
    return scene_.render(seq, SE3());
  }
  InstanceSegmentation mask_of(const RgbdFrame& frame, const std::string& class_name = "person") {
    return scene_.mask(frame, SE3(), {class_name});
  }

  struct Shares {
    double body = 0.0;        ///< of the walker's pixels that are judged dynamic
    double background = 0.0;  ///< of all other pixels
  };
  Shares shares(const RgbdFrame& frame, const cv::Mat& verdicts) {
    const cv::Mat truth = mask_of(frame).labels == 1;
    const cv::Mat dynamic = verdicts == static_cast<double>(FeatureVerdict::kDynamic);
    const cv::Mat hit = dynamic & truth;
    const cv::Mat outside = dynamic & ~truth;
    return {static_cast<double>(cv::countNonZero(hit)) / cv::countNonZero(truth),
            static_cast<double>(cv::countNonZero(outside)) / cv::countNonZero(~truth)};
  }

  SlamConfig config_;
  ObservationModel model_{synthetic::camera(), config_};
  DynamicFilter filter_{config_, model_};
  synthetic::Scene scene_;
};

TEST_F(DynamicFilterTest, MarksADynamicInstanceAndLittleElse) {
  const RgbdFrame frame = render(0);
  const InstanceSegmentation mask = mask_of(frame);
  const Shares marked = shares(frame, filter_.judge_by_class(frame, &mask, SE3()));
  EXPECT_EQ(marked.body, 1.0);
  EXPECT_LT(marked.background, 0.03);
}

TEST_F(DynamicFilterTest, KeepsWhatOnlyMightMoveAndWhatStands) {
  const RgbdFrame frame = render(0);
  const InstanceSegmentation chair = mask_of(frame, "chair");
  const cv::Mat verdicts = filter_.judge_by_class(frame, &chair, SE3());
  EXPECT_EQ(shares(frame, verdicts).body, 0.0);
  EXPECT_GT(cv::countNonZero(verdicts == static_cast<double>(FeatureVerdict::kPotentiallyDynamic)),
            1000);
  const RgbdFrame next = render(1);
  const InstanceSegmentation couch = mask_of(next, "couch");
  DynamicFilter unbiased(config_, model_);
  EXPECT_EQ(cv::countNonZero(unbiased.judge_by_class(next, &couch, SE3())), 0);
}

TEST_F(DynamicFilterTest, DoesNotBelieveAnUncertainInstance) {
  const RgbdFrame frame = render(0);
  InstanceSegmentation mask = mask_of(frame);
  mask.instances[0].score = 0.1F;
  EXPECT_EQ(cv::countNonZero(filter_.judge_by_class(frame, &mask, SE3())), 0);
}

TEST_F(DynamicFilterTest, CarriesAMaskSixFramesForwardAndKeepsTheWallBesideIt) {
  const InstanceSegmentation first = mask_of(render(0));
  const InstanceSegmentation late = mask_of(render(6));
  cv::Mat verdicts;
  for (std::uint64_t seq = 0; seq <= 12; ++seq) {
    verdicts = filter_.judge_by_class(render(seq), seq < 12 ? &first : &late, SE3());
    filter_.note_pose(SE3());
  }
  const Shares marked = shares(render(12), verdicts);
  EXPECT_GT(marked.body, 0.97);
  EXPECT_LT(marked.background, 0.06);
}

TEST_F(DynamicFilterTest, GrowsAMaskWhoseFrameItNeverSaw) {
  const InstanceSegmentation mask = mask_of(render(0));
  const RgbdFrame now = render(5);
  EXPECT_EQ(shares(now, filter_.judge_by_class(now, &mask, SE3())).body, 1.0);
}

TEST_F(DynamicFilterTest, SaysNothingWithoutAMaskOrWithOneTooOld) {
  const InstanceSegmentation mask = mask_of(render(0));
  EXPECT_TRUE(filter_.judge_by_class(render(0), nullptr, SE3()).empty());
  EXPECT_TRUE(filter_.judge_by_class(render(16), &mask, SE3()).empty());
}

TEST_F(DynamicFilterTest, TellsPointsOnTheBodyFromThoseBehindIt) {
  const RgbdFrame frame = render(0);
  const InstanceSegmentation mask = mask_of(frame);
  (void)filter_.judge_by_class(frame, &mask, SE3());
  filter_.note_pose(SE3());
  EXPECT_TRUE(filter_.has_new_mask());
  EXPECT_TRUE(filter_.was_dynamic({-0.25, 0.0, 2.0}));
  EXPECT_FALSE(filter_.was_dynamic({-0.375, 0.0, 3.0}));  // same pixel, on the wall
  EXPECT_FALSE(filter_.was_dynamic({0.5, 0.0, 2.0}));     // same depth, beside
}

/// The filter as the tracker drives it, by a camera that stands at the origin of the world.
class DynamicFilterInMotionTest : public DynamicFilterTest {
 protected:
  struct FeatureShares {
    double body = 0.0;  ///< of the features on the walker that are judged dynamic
    double wall = 0.0;  ///< of all others
  };
  FeatureShares judge(const RgbdFrame& frame, const InstanceSegmentation* mask) {
    const cv::Mat verdicts = filter_.judge_by_class(frame, mask, SE3());
    const auto features = std::make_shared<const Features>(extractor_.extract(frame, verdicts));
    filter_.note_features(features);
    const SE3 T_world_camera;
    const Judgement judgement = filter_.judge_by_motion(*features, &T_world_camera);
    filter_.note_pose(T_world_camera);
    return shares_of(*features, judgement.is_dynamic);
  }
  static FeatureShares shares_of(const Features& features, const std::vector<bool>& is_dynamic) {
    std::array<int, 2> all{};
    std::array<int, 2> dynamic{};
    for (std::size_t i = 0; i < features.size(); ++i) {
      if (!features.items[i].has_depth()) continue;
      const std::size_t on_body = features.items[i].inverse_depth > 0.4F ? 1 : 0;
      ++all[on_body];
      dynamic[on_body] += is_dynamic[i] ? 1 : 0;
    }
    EXPECT_GT(all[0], 200);
    EXPECT_GT(all[1], 50);
    return {static_cast<double>(dynamic[1]) / all[1], static_cast<double>(dynamic[0]) / all[0]};
  }

  FeatureExtractor extractor_{config_.features, synthetic::camera()};
};

TEST_F(DynamicFilterInMotionTest, FindsWhatMovesWithoutAMaskAndKeepsTheWall) {
  for (std::uint64_t seq = 0; seq < 15; ++seq) (void)judge(render(seq), nullptr);
  const FeatureShares dynamic = judge(render(15), nullptr);
  EXPECT_GT(dynamic.body, 0.9);
  EXPECT_LT(dynamic.wall, 0.1);
}

TEST_F(DynamicFilterInMotionTest, DropsAChairWhileItIsPushedAndKeepsItAfterStanding) {
  RgbdFrame frame = render(0);
  InstanceSegmentation mask = mask_of(frame, "chair");
  const auto stand_until = [&](std::uint64_t last) {
    FeatureShares dynamic;
    while (frame.seq < last) {
      ++frame.seq;
      frame.stamp_ns += synthetic::kFramePeriodNs;
      mask.frame_seq = frame.seq;
      mask.stamp_ns = frame.stamp_ns;
      dynamic = judge(frame, &mask);
    }
    return dynamic;
  };
  EXPECT_EQ(stand_until(10).body, 0.0);
  FeatureShares pushed;
  for (std::uint64_t seq = 11; seq <= 20; ++seq) {
    frame = render(seq);
    mask = mask_of(frame, "chair");
    pushed = judge(frame, &mask);
  }
  EXPECT_GT(pushed.body, 0.9);
  EXPECT_LT(pushed.wall, 0.1);
  EXPECT_GT(stand_until(30).body, 0.9);  // it may be pushed again at once
  const FeatureShares stood = stand_until(110);
  EXPECT_LT(stood.body, 0.05);
  EXPECT_LT(stood.wall, 0.02);
}

}  // namespace
}  // namespace tsg
