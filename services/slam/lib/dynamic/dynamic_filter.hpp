#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <deque>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>
#include <vector>

#include "common/geometry/se3.hpp"
#include "common/rgbd/instances.hpp"
#include "common/rgbd/rgbd_frame.hpp"
#include "services/slam/lib/features.hpp"
#include "services/slam/lib/slam_config.hpp"

namespace tsg {

/// Says which pixels of a frame show something that moves, from the latest instance mask. A mask of
/// an earlier frame is carried forward: each dynamic instance is moved with the camera, and with
/// its own velocity between masks, and from there grown over what the depth image shows to be
/// connected to it, as far as it can have moved since. So background next to it is kept.
/// Works on images of a quarter of the size. Owned by the tracking thread.
class DynamicFilter {
 public:
  DynamicFilter(DynamicFilterConfig config, const CameraModel& camera);

  /// Verdicts for the pixels of `frame` (CV_8UC1 of its size, FeatureVerdict); empty if `mask` is
  /// null or too old. `T_world_camera` is the predicted pose of the frame.
  [[nodiscard]] cv::Mat judge(const RgbdFrame& frame,
                              const InstanceSegmentation* mask,
                              const SE3& T_world_camera);

  /// The pose of a frame that was judged, once tracking has found it.
  void note_pose(std::uint64_t seq, const SE3& T_world_camera);

  /// The map was moved, and what is known of past frames moves along.
  void move_world(const SE3& T_moved_world);

  /// The camera goes on in a world of its own: what is known of past frames no longer says where.
  void leave_world();

  /// Whether a point of the map lay on a dynamic instance in the frame of the latest mask. False
  /// where the depth or the pose of that frame is not known.
  [[nodiscard]] bool was_dynamic(const Eigen::Vector3d& p_world) const;

  /// True for the one judge() call that brought a mask not seen before.
  [[nodiscard]] bool has_new_mask() const { return has_new_mask_; }

 private:
  struct PastFrame {
    std::uint64_t seq = 0;
    cv::Mat small_depth;  ///< CV_32FC1, metres, a quarter of the size
    std::optional<SE3> T_world_camera;
  };
  /// A dynamic instance in the frame of the latest mask.
  struct Body {
    std::string class_name;
    std::vector<Eigen::Vector3d> points;                ///< world, its surface
    Eigen::Vector3d centre;                             ///< world
    Eigen::Vector3d v_world = Eigen::Vector3d::Zero();  ///< metres per second
  };

  void remember(const RgbdFrame& frame);
  void take_in(const InstanceSegmentation& mask);
  void measure_bodies(const InstanceSegmentation& mask, const PastFrame& past);
  void estimate_velocities(const std::vector<Body>& before, double seconds);
  [[nodiscard]] cv::Mat carry_forward(const RgbdFrame& frame, const SE3& T_world_camera) const;
  void mark_body(const Body& body, double age_s, const SE3& T_camera_world, cv::Mat& marked) const;
  [[nodiscard]] const PastFrame* find_past(std::uint64_t seq) const;

  DynamicFilterConfig config_;
  CameraModel camera_;
  CameraModel small_camera_;  ///< of the images of a quarter of the size
  std::deque<PastFrame> past_;
  std::optional<std::uint64_t> mask_seq_;
  std::int64_t mask_stamp_ns_ = 0;
  bool has_new_mask_ = false;
  cv::Mat small_dynamic_;  ///< CV_8UC1, of the latest mask: 255 on dynamic instances
  bool placed_ = false;    ///< the latest mask's frame has depth and pose: bodies_ are measured
  std::vector<Body> bodies_;
};

}  // namespace tsg
