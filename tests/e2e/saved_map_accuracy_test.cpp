// How exactly a camera is found in a map that was saved, over a recorded sequence with true poses.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "common/core/statistics.hpp"
#include "common/dataset/evaluation.hpp"
#include "services/slam/lib/map_encoding.hpp"
#include "services/slam/lib/saved_map.hpp"
#include "services/slam/offline/offline_slam.hpp"
#include "tests/support/shared_dir.hpp"
#include "tests/support/temp_folder.hpp"

namespace tsg {
namespace {

using testing::IsEmpty;
using testing::SizeIs;

constexpr double kMostErrorMetres = 0.015;  // RMSE
constexpr std::size_t kMapped = 240;        // frames: three fifths of a full turn

/// A camera that turns round in a room; the map is made of every other frame of the first part.
class SavedMapAccuracy : public ::testing::Test {
 protected:
  void SetUp() override {
    TSG_REQUIRE_SHARED("data/rendered/static_room");
    sequence_ = value_or_throw(open_tum_folder(folder()));
  }
  static std::filesystem::path folder() {
    return test::shared_dir() / "data" / "rendered" / "static_room";
  }

  /// Made once, saved and loaded.
  std::shared_ptr<const MapContents> map() {
    static const auto kMap = [this] {
      OfflineOptions options;
      options.end_frame = kMapped;
      options.take_every_frames = 2;
      const OfflineRun run = value_or_throw(run_offline(sequence_, options));
      const test::TempFolder files;
      static_cast<void>(value_or_throw(save_map(files / "room.tsgmap", *run.map, {}, 1)));
      return std::make_shared<const MapContents>(
          value_or_throw(load_map(files / "room.tsgmap", {})));
    }();
    return kMap;
  }

  OfflineRun go(std::size_t first_frame, std::size_t end_frame, bool localisation_only) {
    OfflineOptions options;
    options.slam.tracker.localisation_only = localisation_only;
    options.map = map();
    options.first_frame = first_frame;
    options.end_frame = end_frame;
    options.take_every_frames = 2;
    return value_or_throw(run_offline(sequence_, options));
  }

  /// Of poses in the frame of the map, which begins where the sequence does: nothing is aligned.
  static double rmse_m(const Trajectory& live) {
    const Trajectory truth = value_or_throw(read_ground_truth(folder()));
    const SE3 T_truth_map = truth[2].T_world_camera;  // at the stamp of the first frame
    std::vector<double> errors_m;
    for (const MatchedPose& pose : value_or_throw(match_poses(truth, live))) {
      const SE3 T_map_camera = T_truth_map.inverse() * pose.T_world_truth;
      const Eigen::Vector3d error =
          pose.T_estimate_camera.translation() - T_map_camera.translation();
      errors_m.push_back(error.norm());
    }
    const Summary summary = summarise(errors_m);
    testing::Test::RecordProperty("rmse_m", std::to_string(summary.rmse));
    testing::Test::RecordProperty("worst_m", std::to_string(summary.max));
    return summary.rmse;
  }

  TumFolder sequence_;
};

TEST_F(SavedMapAccuracy, OfFramesThatTheMapHasNeverSeen) {
  const OfflineRun run = go(1, kMapped, true);
  EXPECT_LE(run.failures.size(), 1U) << "the first frame has to be recognised";
  EXPECT_LE(rmse_m(run.live), kMostErrorMetres);
  EXPECT_EQ(encode_map(*run.map), encode_map(*map())) << "it must not change";
}

TEST_F(SavedMapAccuracy, OnceTheCameraComesFromElsewhereIntoTheMap) {
  const OfflineRun run = go(301, 401, true);
  ASSERT_THAT(run.live, SizeIs(testing::Ge(10U)));
  testing::Test::RecordProperty("lost_frames", static_cast<int>(run.failures.size()));
  EXPECT_LE(rmse_m(run.live), kMostErrorMetres);
  EXPECT_EQ(encode_map(*run.map), encode_map(*map()));
}

TEST_F(SavedMapAccuracy, OfAMapThatGoesOnGrowing) {
  const OfflineRun run = go(201, 301, false);
  EXPECT_LE(run.failures.size(), 1U);
  EXPECT_GT(run.map_keyframes, map()->keyframes.size());
  EXPECT_LE(rmse_m(run.live), kMostErrorMetres);
}

}  // namespace
}  // namespace tsg
