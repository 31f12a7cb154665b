#include "services/slam/lib/feature_extractor.hpp"

#include <gtest/gtest.h>

#include <opencv2/calib3d.hpp>

#include "services/slam/lib/depth_sampler.hpp"
#include "services/slam/lib/oriented_brief.hpp"
#include "services/slam/lib/synthetic_scene.hpp"

namespace tsg {
namespace {

const synthetic::Scene& empty_room() {
  static const synthetic::Scene kRoom = synthetic::Scene::room();
  return kRoom;
}

TEST(FeatureExtractor, SpreadsFeaturesOverTheWholeImage) {
  FeatureExtractor extractor(FeatureConfig{}, synthetic::camera());
  const Features features = extractor.extract(empty_room().render(0, SE3()), {});
  EXPECT_GE(features.size(), 900U);
  EXPECT_LE(features.size(), 1000U);
  std::array<int, 16> counts{};
  for (const Feature& feature : features.items) {
    ++counts[static_cast<std::size_t>(feature.raw_y / 120 * 4 + feature.raw_x / 160)];
  }
  for (const int count : counts) EXPECT_GE(count, 25);
}

TEST(FeatureExtractor, FindsTheSameInTheSameImage) {
  FeatureExtractor used(FeatureConfig{}, synthetic::camera());
  (void)used.extract(empty_room().render(0, synthetic::pose_at(0.3, 0.0, 0.0)), {});
  FeatureExtractor fresh(FeatureConfig{}, synthetic::camera());
  const RgbdFrame frame = empty_room().render(1, SE3());
  const Features a = used.extract(frame, {});
  const Features b = fresh.extract(frame, {});
  ASSERT_EQ(a.size(), b.size());
  EXPECT_EQ(a.descriptors, b.descriptors);
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_EQ(a.items[i].pixel, b.items[i].pixel);
}

TEST(FeatureExtractor, LeavesOutDynamicPixelsAndCountsThem) {
  cv::Mat verdicts(480, 640, CV_8UC1, cv::Scalar(0));
  verdicts(cv::Rect(0, 0, 320, 480)) = static_cast<double>(FeatureVerdict::kDynamic);
  verdicts(cv::Rect(320, 0, 320, 240)) = static_cast<double>(FeatureVerdict::kPotentiallyDynamic);
  FeatureExtractor extractor(FeatureConfig{}, synthetic::camera());
  const Features features = extractor.extract(empty_room().render(0, SE3()), verdicts);
  EXPECT_GT(features.counts.dynamic, 100);
  EXPECT_GT(features.counts.potentially_dynamic, 100);
  for (const Feature& feature : features.items) EXPECT_GE(feature.raw_x, 320);
}

TEST(FeatureExtractor, FindsNothingInABlankImage) {
  RgbdFrame frame = empty_room().render(0, SE3());
  frame.colour = cv::Scalar::all(127);
  FeatureExtractor extractor(FeatureConfig{}, synthetic::camera());
  EXPECT_EQ(extractor.extract(frame, {}).size(), 0U);
}

TEST(FeatureExtractor, UndistortsPixelsAndKeepsTheRawOnes) {
  CameraModel camera = synthetic::camera();
  camera.distortion = {0.2624, -0.9531, -0.0054, 0.0026, 1.1633};
  FeatureExtractor extractor(FeatureConfig{}, camera);
  const Features features = extractor.extract(empty_room().render(0, SE3()), {});
  const cv::Matx33d K(camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1);
  for (const Feature& feature : features.items) {
    const cv::Point3d ray((feature.pixel.x() - camera.cx) / camera.fx,
                          (feature.pixel.y() - camera.cy) / camera.fy, 1.0);
    std::vector<cv::Point2d> distorted;
    cv::projectPoints(std::vector<cv::Point3d>{ray}, cv::Vec3d(), cv::Vec3d(), K, camera.distortion,
                      distorted);
    EXPECT_NEAR(distorted[0].x, feature.raw_x, 0.6);
    EXPECT_NEAR(distorted[0].y, feature.raw_y, 0.6);
  }
}

TEST(OrientedBrief, StaysAlikeWhenTheImageTurns) {
  const cv::Mat frame = empty_room().render(0, SE3()).colour;
  cv::Mat grey;
  cv::cvtColor(frame, grey, cv::COLOR_BGR2GRAY);
  cv::GaussianBlur(grey, grey, {7, 7}, 2.0);
  cv::Mat turned;
  cv::rotate(grey, turned, cv::ROTATE_90_CLOCKWISE);
  int sum = 0;
  int count = 0;
  for (int y = 40; y < 440; y += 40) {
    for (int x = 40; x < 600; x += 40) {
      const Descriptor before = oriented_brief(grey, x, y, intensity_direction(grey, x, y));
      const int turned_x = grey.rows - 1 - y;
      const Descriptor after =
          oriented_brief(turned, turned_x, x, intensity_direction(turned, turned_x, x));
      sum += hamming_distance(before, after);
      ++count;
    }
  }
  EXPECT_LT(sum / count, 15);
}

class DepthSampler : public testing::Test {
 protected:
  [[nodiscard]] float sample(int x, int y) const {
    return sample_inverse_depth(depth_, 1000.0, {x, y}, FeatureConfig{});
  }
  cv::Mat depth_{40, 40, CV_16UC1, cv::Scalar(2000)};
};

TEST_F(DepthSampler, MeasuresASurfaceInSpiteOfHoles) {
  depth_.at<std::uint16_t>(20, 20) = 0;
  EXPECT_FLOAT_EQ(sample(20, 20), 0.5F);
  EXPECT_FLOAT_EQ(sample(0, 0), 0.5F);
}

TEST_F(DepthSampler, TakesTheNearSideOfAnEdge) {
  depth_(cv::Rect(0, 0, 20, 40)) = 1000;
  EXPECT_FLOAT_EQ(sample(20, 20), 1.0F);
  EXPECT_FLOAT_EQ(sample(30, 20), 0.5F);
}

TEST_F(DepthSampler, KnowsNothingWhereFewPixelsAgree) {
  depth_ = cv::Scalar(0);
  for (int i = 0; i < 4; ++i) depth_.at<std::uint16_t>(20, 18 + i) = 2000;
  EXPECT_EQ(sample(20, 20), 0.0F);
}

TEST_F(DepthSampler, DoesNotBelieveWhatIsOutOfRange) {
  depth_ = cv::Scalar(100);
  EXPECT_EQ(sample(20, 20), 0.0F);
  depth_ = cv::Scalar(9000);
  EXPECT_EQ(sample(20, 20), 0.0F);
}

TEST(KeepSpread, DependsOnTheCornersNotOnTheirOrder) {
  std::mt19937 generator(1);
  std::vector<cv::KeyPoint> corners;
  for (int i = 0; i < 500; ++i) {
    corners.emplace_back(static_cast<float>(generator() % 640),
                         static_cast<float>(generator() % 480), 7.0F, -1.0F,
                         static_cast<float>(generator() % 200));
  }
  std::vector<cv::KeyPoint> shuffled = corners;
  std::shuffle(shuffled.begin(), shuffled.end(), generator);
  keep_spread(corners, {640, 480}, 100);
  keep_spread(shuffled, {640, 480}, 100);
  ASSERT_EQ(corners.size(), 100U);
  for (std::size_t i = 0; i < corners.size(); ++i) EXPECT_EQ(corners[i].pt, shuffled[i].pt);
}

}  // namespace
}  // namespace tsg
