#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <deque>
#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

#include "common/geometry/camera_model.hpp"
#include "common/geometry/se3.hpp"
#include "common/rgbd/instances.hpp"
#include "services/slam/lib/dynamic/known_background.hpp"
#include "services/slam/lib/dynamic/motion_evidence.hpp"
#include "services/slam/lib/dynamic/past_frames.hpp"
#include "services/slam/lib/slam_config.hpp"

namespace tsg {

/// A thing that may move, followed from mask to mask; or one that was seen to move and has no name,
/// as no mask tells of it.
struct InstanceTrack {
  int id = 0;
  std::string class_name;  ///< empty where nobody named it
  FeatureVerdict prior = FeatureVerdict::kPotentiallyDynamic;
  MotionEvidence evidence;
  std::vector<Eigen::Vector3d> points;                ///< world, its surface at `stamp_ns`
  Eigen::Vector3d v_world = Eigen::Vector3d::Zero();  ///< metres per second
  std::int64_t stamp_ns = 0;                          ///< of the last mask that showed it
  int missed_masks = 0;                               ///< since then; 0 without a name
  struct Place {
    std::int64_t stamp_ns = 0;
    Eigen::Vector3d centre;  ///< world
  };
  std::deque<Place> trail;  ///< of the last half second, oldest first

  [[nodiscard]] bool is_named() const { return !class_name.empty(); }
  [[nodiscard]] bool is_moving() const {
    return prior == FeatureVerdict::kDynamic || evidence.is_moving();
  }
};

/// Follows the instances of dynamic and potentially dynamic classes. Between masks, and where a
/// mask fails to show one, each is carried on with its velocity and laid onto what the depth image
/// shows there, so that background beside it is kept.
class InstanceTracks {
 public:
  InstanceTracks(DynamicFilterConfig config, const CameraModel& cell_camera);

  /// Takes in a mask with what is remembered of its frame, taken from `T_world_camera`.
  void take_in(const InstanceSegmentation& mask, const PastFrame& frame, const SE3& T_world_camera);

  /// Takes in what moves without a name: `moving` (CV_8UC1 of cells, 255) as seen in a frame for
  /// which locate() gave `located`. Whatever has moved once may do so again, so it is followed at
  /// rest too.
  void take_in_unnamed(const cv::Mat& moving,
                       const cv::Mat& located,
                       const PastFrame& frame,
                       const SE3& T_world_camera);

  /// Drops what has no name and is gone, or has stood still for long.
  void drop_unnamed(const PastFrame& frame, const SE3& T_world_camera);

  /// Where each is in a frame: CV_8UC1 of cells, i + 1 for tracks()[i], 0 elsewhere.
  /// `is_of_mask`: the mask that was last taken in belongs to this very frame.
  [[nodiscard]] cv::Mat locate(const PastFrame& frame,
                               const SE3& T_world_camera,
                               bool is_of_mask) const;

  [[nodiscard]] const std::vector<InstanceTrack>& tracks() const { return tracks_; }
  /// Adds what a frame says of tracks()[i].
  void add_evidence(std::size_t i, const MotionCounts& counts) { tracks_[i].evidence.add(counts); }

  void move_world(const SE3& T_moved_world);
  void clear() {
    tracks_.clear();
    background_.clear();
  }
  /// There are no masks any more.
  void drop_named() {
    background_.clear();
    std::erase_if(tracks_, [](const InstanceTrack& track) { return track.is_named(); });
  }

 private:
  [[nodiscard]] std::vector<InstanceTrack> measure(const InstanceSegmentation& mask,
                                                   const PastFrame& frame,
                                                   const SE3& T_world_camera) const;
  [[nodiscard]] int find_same(const InstanceTrack& seen, const std::vector<bool>& taken) const;
  static void follow(InstanceTrack& track, InstanceTrack seen);
  [[nodiscard]] InstanceTrack seen_at(const cv::Mat& cells,
                                      const PastFrame& frame,
                                      const SE3& T_world_camera) const;
  void drop_lost(const PastFrame& frame, const SE3& T_world_camera);
  struct Support {
    int in_view = 0;  ///< cells
    int there = 0;    ///< of these, where the sensor sees something at about its depth
    [[nodiscard]] double share() const {
      return in_view == 0 ? 0.0 : static_cast<double>(there) / in_view;
    }
  };
  [[nodiscard]] Support support(const InstanceTrack& track,
                                const PastFrame& frame,
                                const SE3& T_camera_world) const;
  [[nodiscard]] std::size_t find_unnamed(const cv::Mat& region, const cv::Mat& located);
  /// Calls `visit(cell, depth_m)` for each point in view, moved on to the time of `stamp_ns`.
  template <typename Visit>
  void for_each_cell(const InstanceTrack& track,
                     std::int64_t stamp_ns,
                     const SE3& T_camera_world,
                     const Visit& visit) const;
  [[nodiscard]] cv::Mat mark_exact(const InstanceSegmentation& mask, const cv::Mat& depth) const;
  void mark_carried(std::size_t i,
                    const PastFrame& frame,
                    const SE3& T_camera_world,
                    const cv::Mat& background,
                    cv::Mat& located) const;

  DynamicFilterConfig config_;
  CameraModel camera_;  ///< of cells
  std::vector<InstanceTrack> tracks_;
  cv::Mat located_by_mask_;  ///< what locate() gives for the latest mask's own frame
  KnownBackground background_;
  std::vector<int> track_of_label_;  ///< of the latest mask: index in tracks_, or -1
  int next_id_ = 1;
};

}  // namespace tsg
