#include "services/slam/lib/dynamic/known_background.hpp"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "services/slam/lib/dynamic/depth_cells.hpp"
#include "services/slam/lib/synthetic_scene.hpp"

namespace tsg {
namespace {

const cv::Rect kPersonCells(60, 40, 30, 40);
const cv::Rect kElsewhere(100, 40, 30, 40);

cv::Mat wall_with_person(const cv::Rect& cells, float person_m = 2.7F) {
  cv::Mat depth(120, 160, CV_32FC1, cv::Scalar(3.0));
  depth(cells) = person_m;
  return depth;
}

cv::Mat mask_of(const cv::Rect& cells) {
  cv::Mat things = cv::Mat::zeros(120, 160, CV_8UC1);
  things(cells) = 1;
  return things;
}

class KnownBackgroundTest : public testing::Test {
 protected:
  [[nodiscard]] cv::Mat find(const cv::Mat& depth, const SE3& T_world_camera = SE3()) const {
    return known_.find(camera_of_cells(synthetic::camera()), depth, T_world_camera);
  }

  KnownBackground known_;
};

TEST_F(KnownBackgroundTest, IsWhatTheMaskLeftAndIsSeenAgain) {
  known_.note(wall_with_person(kPersonCells), mask_of(kPersonCells), SE3());
  const cv::Mat background = find(wall_with_person(kElsewhere));
  EXPECT_EQ(cv::countNonZero(background(kElsewhere)), 0) << "a person in front of it";
  EXPECT_EQ(cv::countNonZero(background(kPersonCells)), 0) << "was hidden by the person";
  const cv::Rect beside(10, 40, 40, 40);
  EXPECT_EQ(cv::countNonZero(background(beside)), beside.area());
}

TEST_F(KnownBackgroundTest, IsNotThePersonWhoStandsStill) {
  known_.note(wall_with_person(kPersonCells), mask_of(kPersonCells), SE3());
  const cv::Mat background = find(wall_with_person(kPersonCells));
  EXPECT_EQ(cv::countNonZero(background(kPersonCells)), 0);
  const cv::Rect rim(kPersonCells.x - 1, kPersonCells.y, 1, kPersonCells.height);
  EXPECT_EQ(cv::countNonZero(background(rim)), 0) << "masks are cut short";
}

TEST_F(KnownBackgroundTest, IsFoundFromElsewhereAndAfterTheWorldWasMoved) {
  const SE3 T_moved_world = synthetic::pose_at(1.0, -2.0, 0.5, 0.7);
  known_.note(wall_with_person(kPersonCells), mask_of(kPersonCells), SE3());
  known_.move_world(T_moved_world);
  cv::Mat nearer(120, 160, CV_32FC1, cv::Scalar(2.9));
  const cv::Mat background = find(nearer, T_moved_world * synthetic::pose_at(0.0, 0.0, 0.1));
  EXPECT_GT(cv::countNonZero(background), 120 * 160 * 8 / 10);
  EXPECT_EQ(cv::countNonZero(find(nearer, SE3())), 0) << "where the world was before";
}

TEST_F(KnownBackgroundTest, IsNowhereBeforeAMaskAndAfterAllIsForgotten) {
  const cv::Mat depth = wall_with_person(kPersonCells);
  EXPECT_EQ(cv::countNonZero(find(depth)), 0);
  known_.note(depth, mask_of(kPersonCells), SE3());
  known_.clear();
  EXPECT_EQ(cv::countNonZero(find(depth)), 0);
}

}  // namespace
}  // namespace tsg
