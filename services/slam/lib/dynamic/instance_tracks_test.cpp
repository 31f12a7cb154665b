#include "services/slam/lib/dynamic/instance_tracks.hpp"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "services/slam/lib/dynamic/depth_cells.hpp"
#include "services/slam/lib/synthetic_scene.hpp"

namespace tsg {
namespace {

constexpr std::int64_t kSecond = 1'000'000'000;

/// A board of 0.5 m by 0.6 m whose left edge is at `x`.
synthetic::Panel board(double x, double z = 2.0, std::uint8_t label = 1) {
  return {.z = z, .corner = {x, -0.3}, .extent = {0.5, 0.6}, .texture_seed = 9, .label = label};
}

class InstanceTracksTest : public testing::Test {
 protected:
  InstanceTracksTest()
      : scene_({{.z = 3.0, .corner = {-4.0, -3.0}, .extent = {8.0, 6.0}, .texture_seed = 1},
                board(-0.25)}) {}

  /// A new frame of the scene as it is.
  void look(std::int64_t later_ns = synthetic::kFramePeriodNs) {
    image_ = scene_.render(image_.seq + 1, SE3());
    now_ = {
        .seq = image_.seq, .stamp_ns = now_.stamp_ns + later_ns, .depth = depth_of_cells(image_)};
  }
  void take_in(const std::vector<std::string>& class_names) {
    tracks_.take_in(scene_.mask(image_, SE3(), class_names), now_, SE3());
  }
  /// The mask shows nothing.
  void miss() {
    InstanceSegmentation empty;
    empty.labels = cv::Mat::zeros(480, 640, CV_8UC1);
    tracks_.take_in(empty, now_, SE3());
  }
  [[nodiscard]] cv::Mat board_cells() const { return now_.depth == 2.0; }
  void see_it_move() {
    const cv::Mat nothing = cv::Mat::zeros(now_.depth.size(), CV_8UC1);
    tracks_.take_in_unnamed(board_cells(), nothing, now_, SE3());
  }

  InstanceTracks tracks_{DynamicFilterConfig{}, camera_of_cells(synthetic::camera())};
  synthetic::Scene scene_;
  RgbdFrame image_;
  PastFrame now_;
};

TEST_F(InstanceTracksTest, CarriesWhatAMaskMissesForSomeMasksOnly) {
  look();
  take_in({"chair"});
  for (int missed = 1; missed <= 3; ++missed) {
    look();
    miss();
    ASSERT_EQ(tracks_.tracks().size(), 1U);
    EXPECT_EQ(tracks_.tracks()[0].missed_masks, missed);
    const cv::Mat on_board = (tracks_.locate(now_, SE3(), false) == 1) & board_cells();
    EXPECT_GT(cv::countNonZero(on_board), 0.95 * cv::countNonZero(board_cells()));
  }
  look();
  miss();
  EXPECT_TRUE(tracks_.tracks().empty());
}

TEST_F(InstanceTracksTest, DropsWhatIsMissedAndGone) {
  look();
  take_in({"chair"});
  scene_.panel(1) = board(5.0);
  look();
  miss();
  EXPECT_TRUE(tracks_.tracks().empty());
}

TEST_F(InstanceTracksTest, FollowsEachUnderItsId) {
  scene_.panel(1) = board(-0.8);
  scene_.add(board(0.2, 2.0, 2));
  look();
  take_in({"chair", "chair"});
  ASSERT_EQ(tracks_.tracks().size(), 2U);
  const int left = tracks_.tracks()[0].id;
  const int right = tracks_.tracks()[1].id;
  EXPECT_NE(left, right);
  // The next masks list them the other way round.
  for (int i = 1; i <= 5; ++i) {
    scene_.panel(1) = board(-0.8 + 0.1 * i, 2.0, 2);
    scene_.panel(2) = board(0.2 + 0.1 * i, 2.0, 1);
    look(kSecond / 5);
    take_in({"chair", "chair"});
  }
  ASSERT_EQ(tracks_.tracks().size(), 2U);
  EXPECT_EQ(tracks_.tracks()[0].id, left);
  EXPECT_NEAR(tracks_.tracks()[0].trail.back().centre.x(), -0.05, 0.02);
  EXPECT_NEAR(tracks_.tracks()[0].v_world.x(), 0.5, 0.05);
  EXPECT_NEAR(tracks_.tracks()[1].trail.back().centre.x(), 0.95, 0.1);
}

TEST_F(InstanceTracksTest, AnotherClassIsAnotherThing) {
  look();
  take_in({"chair"});
  const int chair = tracks_.tracks()[0].id;
  look();
  take_in({"suitcase"});
  ASSERT_EQ(tracks_.tracks().size(), 2U);
  EXPECT_EQ(tracks_.tracks()[0].id, chair);
  EXPECT_EQ(tracks_.tracks()[1].class_name, "suitcase");
}

TEST_F(InstanceTracksTest, FollowsTheUnnamedAtRestOnceItSurelyMoved) {
  look();
  see_it_move();
  ASSERT_EQ(tracks_.tracks().size(), 1U);
  EXPECT_FALSE(tracks_.tracks()[0].is_named());
  EXPECT_TRUE(tracks_.tracks()[0].is_moving());
  for (int i = 0; i < 5; ++i) tracks_.add_evidence(0, {.features_moved = 20});
  for (int i = 0; i < 60; ++i) tracks_.add_evidence(0, {.features_still = 20});
  EXPECT_FALSE(tracks_.tracks()[0].is_moving());
  look(10 * kSecond);
  tracks_.drop_unnamed(now_, SE3());
  ASSERT_EQ(tracks_.tracks().size(), 1U);
  const cv::Mat located = tracks_.locate(now_, SE3(), false) == 1;
  EXPECT_GT(cv::countNonZero(located & board_cells()), 0.95 * cv::countNonZero(board_cells()));
  EXPECT_EQ(cv::countNonZero(located & ~board_cells()), 0);
  look(11 * kSecond);  // furniture by now
  tracks_.drop_unnamed(now_, SE3());
  EXPECT_TRUE(tracks_.tracks().empty());
}

TEST_F(InstanceTracksTest, GivesPlacesToWhatHasANameFirst) {
  look();
  see_it_move();
  look();
  take_in({"chair"});
  ASSERT_EQ(tracks_.tracks().size(), 2U);
  ASSERT_FALSE(tracks_.tracks()[0].is_named());
  ASSERT_TRUE(tracks_.tracks()[1].is_named());
  const cv::Mat located = tracks_.locate(now_, SE3(), false);
  EXPECT_GT(cv::countNonZero((located == 2) & board_cells()),
            0.95 * cv::countNonZero(board_cells()));
  EXPECT_EQ(cv::countNonZero(located == 1), 0);
}

TEST_F(InstanceTracksTest, SoonForgetsTheUnnamedThatHardlyMoved) {
  look();
  see_it_move();
  look(kSecond / 4);
  tracks_.drop_unnamed(now_, SE3());
  EXPECT_EQ(tracks_.tracks().size(), 1U);
  look(kSecond / 2);
  tracks_.drop_unnamed(now_, SE3());
  EXPECT_TRUE(tracks_.tracks().empty());
}

TEST_F(InstanceTracksTest, DropsTheUnnamedWhenItIsGone) {
  look();
  see_it_move();
  for (int i = 0; i < 5; ++i) tracks_.add_evidence(0, {.features_moved = 20});
  scene_.panel(1) = board(5.0);
  look();
  tracks_.drop_unnamed(now_, SE3());
  EXPECT_TRUE(tracks_.tracks().empty());
}

/// The depth of the wall and of the board's is within what belongs to one surface.
TEST_F(InstanceTracksTest, KeepsTheWallThatAPersonStandsAgainstWhenTheMaskIsLate) {
  scene_.panel(0).z = 2.06;
  look();
  take_in({"person"});
  look(kSecond / 3);
  const cv::Mat located = tracks_.locate(now_, SE3(), false) == 1;
  EXPECT_GT(cv::countNonZero(located & board_cells()), 0.95 * cv::countNonZero(board_cells()));
  cv::Mat rim;
  cv::dilate(board_cells(), rim, cv::Mat(), {-1, -1}, 6);  // of 33 that it may have moved
  EXPECT_EQ(cv::countNonZero(located & ~rim), 0);
}

TEST_F(InstanceTracksTest, DoesNotLookForAPersonWhereTheSensorSeesNothing) {
  look();
  take_in({"person"});
  scene_.panel(1) = board(0.05);
  scene_.panel(0).z = 50.0;
  look(kSecond / 3);
  now_.depth.setTo(0.0, ~board_cells());
  const cv::Mat located = tracks_.locate(now_, SE3(), false) == 1;
  EXPECT_GT(cv::countNonZero(located & board_cells()), 0.5 * cv::countNonZero(board_cells()))
      << "0.3 m on";
  EXPECT_EQ(cv::countNonZero(located & ~board_cells()), 0);
}

TEST_F(InstanceTracksTest, FillsWhatTheSensorMissesOfAPerson) {
  look();
  take_in({"person"});
  look();
  const cv::Mat board = board_cells();
  const cv::Rect hair(cv::boundingRect(board).tl() + cv::Point(5, 5), cv::Size(3, 3));
  now_.depth(hair) = 0.0;
  const cv::Mat located = tracks_.locate(now_, SE3(), false) == 1;
  EXPECT_EQ(cv::countNonZero(located(hair)), hair.area());
}

}  // namespace
}  // namespace tsg
