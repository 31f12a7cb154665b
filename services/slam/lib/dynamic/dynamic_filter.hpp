#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <vector>

#include "common/geometry/se3.hpp"
#include "common/rgbd/instances.hpp"
#include "common/rgbd/rgbd_frame.hpp"
#include "services/slam/lib/dynamic/feature_motion.hpp"
#include "services/slam/lib/dynamic/frame_verdicts.hpp"
#include "services/slam/lib/dynamic/instance_tracks.hpp"
#include "services/slam/lib/dynamic/past_frames.hpp"
#include "services/slam/lib/features.hpp"
#include "services/slam/lib/observation_model.hpp"
#include "services/slam/lib/slam_config.hpp"

namespace tsg {

/// Which features of a frame move.
struct Judgement {
  std::vector<bool> is_dynamic;          ///< per feature; empty: none is
  std::vector<bool> is_doubtful;         ///< per feature: not seen to stand still; empty: none
  std::vector<float> epipolar_px;        ///< per feature, negative where untested; empty: no test
  cv::Mat dynamic_cells;                 ///< CV_8UC1 of cells, 255 = moves; empty: none does
  std::vector<InstanceState> instances;  ///< all that may move
};

/// Tells what moves in a frame, by the method that the configuration names. In two steps, as the
/// paper couples them (section 4.3): what classes say comes before the pose and makes it reliable,
/// what geometry says rests on that pose. Owned by the tracking thread.
class DynamicFilter {
 public:
  DynamicFilter(const SlamConfig& config, const ObservationModel& model);

  /// What the latest mask says of the pixels of `frame` (CV_8UC1 of its size, FeatureVerdict);
  /// empty where it says nothing. `mask` may be null or of an earlier frame; then what it shows is
  /// carried on to this one. `T_world_camera` is the predicted pose.
  [[nodiscard]] cv::Mat judge_by_class(const RgbdFrame& frame,
                                       const InstanceSegmentation* mask,
                                       const SE3& T_world_camera);

  /// Whether features on kDynamic pixels are to be left out at once, or shall be judged as well.
  [[nodiscard]] bool leaves_out_by_class() const;

  /// The features of the frame, before any was judged by motion.
  void note_features(const std::shared_ptr<const Features>& features) {
    past_.now().features = features;
  }

  /// The verdict on the features of that frame, by its pose from those of static classes; null
  /// where there is no pose.
  [[nodiscard]] Judgement judge_by_motion(const Features& features, const SE3* T_world_camera);

  /// The pose of the frame, once tracking has found it.
  void note_pose(const SE3& T_world_camera);

  /// The map was moved, and what is known of past frames moves along.
  void move_world(const SE3& T_moved_world);

  /// The camera goes on in a world of its own: what is known of past frames no longer says where.
  void leave_world();

  /// Whether a point of the map lay on a dynamic instance in the frame of the latest mask. False
  /// where the depth or the pose of that frame is not known.
  [[nodiscard]] bool was_dynamic(const Eigen::Vector3d& p_world) const;

  /// Whether a mask had a part in what judge_by_class() said.
  [[nodiscard]] bool uses_mask() const { return uses_mask_; }

  /// True for the one frame that brought a mask not seen before.
  [[nodiscard]] bool has_new_mask() const { return has_new_mask_; }

 private:
  [[nodiscard]] cv::Mat judge_by_place(const RgbdFrame& frame,
                                       const InstanceSegmentation* mask,
                                       const SE3& T_world_camera);
  [[nodiscard]] bool take_in(const InstanceSegmentation& mask, const SE3& T_world_camera);
  [[nodiscard]] cv::Mat by_place(const InstanceSegmentation* exact, const cv::Size& size) const;
  [[nodiscard]] Judgement judge_by_epipolar(const Features& features) const;
  [[nodiscard]] Judgement judge_by_depth(const Features& features, const SE3& T_world_camera);
  [[nodiscard]] cv::Mat compare_with_past(const SE3& T_world_camera) const;
  [[nodiscard]] std::vector<FeatureMotion> compare_with_reference(const Features& features,
                                                                  const SE3& T_world_camera) const;
  void weigh_tracks(const Features& features,
                    const std::vector<FeatureMotion>& motion,
                    const cv::Mat& evidence);
  [[nodiscard]] cv::Mat moving_cells(const cv::Mat& unnamed) const;
  [[nodiscard]] std::vector<bool> doubt(const std::vector<FeatureMotion>& motion, cv::Mat moving);
  [[nodiscard]] std::vector<InstanceState> states() const;

  DynamicFilterConfig config_;
  const ObservationModel& model_;
  CameraModel cell_camera_;
  PastFrames past_;
  InstanceTracks tracks_;
  cv::Mat located_;  ///< of the frame being judged: CV_8UC1 of cells, i + 1 for tracks()[i]
  std::optional<std::uint64_t> mask_seq_;
  cv::Mat mask_dynamic_;  ///< CV_8UC1 of cells, of the latest mask: 255 on dynamic classes
  bool has_new_mask_ = false;
  bool uses_mask_ = false;
  std::optional<std::int64_t> unnamed_seen_ns_;  ///< when something moved that no mask told of
};

}  // namespace tsg
