#include "services/slam/lib/dynamic/seen_through.hpp"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "services/slam/lib/dynamic/depth_cells.hpp"
#include "services/slam/lib/synthetic_scene.hpp"

namespace tsg {
namespace {

const cv::Rect kBoardCells(60, 40, 30, 40);  // cells
constexpr int kOutline = 2 * (160 + 118);

cv::Mat wall() { return {120, 160, CV_32FC1, cv::Scalar(3.0)}; }

cv::Mat wall_with_board() {
  cv::Mat depth = wall();
  depth(kBoardCells) = 2.0;
  return depth;
}

int count(const cv::Mat& evidence, CellEvidence what) {
  return cv::countNonZero(evidence == static_cast<double>(what));
}

class SeenThroughTest : public testing::Test {
 protected:
  void compare(const cv::Mat& now,
               const cv::Mat& then,
               const SE3& T_world_now = SE3(),
               const SE3& T_world_then = SE3()) {
    compare_depth(camera_of_cells(model_.camera()), {now, T_world_now}, {then, T_world_then},
                  model_.inverse_depth_sigma(), evidence_);
  }

  ObservationModel model_{synthetic::camera(), SlamConfig{}};
  cv::Mat evidence_ = cv::Mat::zeros(120, 160, CV_8UC1);
};

TEST_F(SeenThroughTest, ABoardThatComesInFrontOfAWallAppeared) {
  compare(wall_with_board(), wall());
  EXPECT_EQ(count(evidence_(kBoardCells), CellEvidence::kAppeared), kBoardCells.area());
  EXPECT_EQ(count(evidence_, CellEvidence::kAppeared), kBoardCells.area());
  EXPECT_EQ(count(evidence_, CellEvidence::kSame), 120 * 160 - kBoardCells.area() - kOutline);
}

TEST_F(SeenThroughTest, AnUncoveredWallWasHidden) {
  compare(wall(), wall_with_board());
  EXPECT_EQ(count(evidence_(kBoardCells), CellEvidence::kNone), kBoardCells.area());
  EXPECT_EQ(count(evidence_, CellEvidence::kAppeared), 0);
  EXPECT_EQ(count(evidence_, CellEvidence::kSame), 120 * 160 - kBoardCells.area() - kOutline);
}

TEST_F(SeenThroughTest, AStaticSceneIsTheSameUnderAMovedCamera) {
  const auto room = synthetic::Scene::room();
  const SE3 T_world_now = synthetic::pose_at(0.15, 0.05, 0.1, 0.08);
  compare(depth_of_cells(room.render(9, T_world_now)), depth_of_cells(room.render(0, SE3())),
          T_world_now);
  EXPECT_EQ(count(evidence_, CellEvidence::kAppeared), 0);
  EXPECT_GT(count(evidence_, CellEvidence::kSame), 0.75 * 120 * 160);
}

TEST_F(SeenThroughTest, MissingDepthSaysNothing) {
  cv::Mat hole = wall();
  hole(cv::Rect(70, 50, 1, 1)) = 0.0;
  compare(wall_with_board(), hole);
  // What lies beside a hole may be a thin thing that the sensor missed.
  EXPECT_EQ(count(evidence_(cv::Rect(69, 49, 3, 3)), CellEvidence::kNone), 9);
  EXPECT_EQ(count(evidence_, CellEvidence::kAppeared), kBoardCells.area() - 9);
  evidence_ = 0.0;
  compare(cv::Mat::zeros(120, 160, CV_32FC1), wall());
  compare(wall(), cv::Mat::zeros(120, 160, CV_32FC1));
  EXPECT_EQ(cv::countNonZero(evidence_), 0);
}

TEST_F(SeenThroughTest, WhatWasThereEarlierDidNotAppear) {
  compare(wall_with_board(), wall());
  compare(wall_with_board(), wall_with_board());
  EXPECT_EQ(count(evidence_(kBoardCells), CellEvidence::kSame), kBoardCells.area());
  EXPECT_EQ(count(evidence_, CellEvidence::kAppeared), 0);
}

TEST_F(SeenThroughTest, DropsSpecks) {
  evidence_(cv::Rect(10, 10, 4, 6)) = static_cast<double>(CellEvidence::kAppeared);
  evidence_(cv::Rect(50, 50, 23, 1)) = static_cast<double>(CellEvidence::kAppeared);
  evidence_(cv::Rect(90, 90, 20, 20)) = static_cast<double>(CellEvidence::kSame);
  const cv::Mat regions = appeared_regions(evidence_, 24);
  EXPECT_EQ(cv::countNonZero(regions), 24);
  EXPECT_EQ(cv::countNonZero(regions(cv::Rect(10, 10, 4, 6)) == 255), 24);
}

}  // namespace
}  // namespace tsg
