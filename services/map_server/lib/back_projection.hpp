#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "services/map_server/lib/class_table.hpp"
#include "services/map_server/lib/cloud.hpp"
#include "services/map_server/lib/depth_filter.hpp"
#include "services/map_server/lib/exclusion.hpp"
#include "services/map_server/lib/keyframe.hpp"

namespace tsg {

/// What one keyframe shows of the static world, in camera axes.
struct KeyframeCloud {
  Cloud points;
  /// Ends of rays that met nothing within the range of the map: the space up to them is free.
  std::vector<Eigen::Vector3f> free_ends;
  /// Of each point: 0 background, i + 1 instances[i].
  std::vector<std::uint8_t> label_of_point;
};

/// Turns keyframes into clouds by the paper's eq. 5-6. Pixels are undistorted on the way; the ray
/// of every pixel is computed once per camera. One owner.
class BackProjector {
 public:
  /// Pixels that look farther sideways (x/z or y/z) are left out: 72 degrees off the axis, where
  /// no pinhole camera sees, only a wrong calibration.
  static constexpr double kMaxTangent = 3.0;

  BackProjector(DepthFilterConfig depth, ExclusionConfig exclusion);

  /// `keyframe` must have passed check_keyframe(). New class names are added to `classes`.
  [[nodiscard]] KeyframeCloud project(const MapKeyframe& keyframe, ClassTable& classes);

 private:
  void prepare_rays(const CameraModel& camera);
  [[nodiscard]] Eigen::Vector3f point_at(int u, int v, float depth_m) const;
  [[nodiscard]] std::vector<Eigen::Vector3f> free_ends(const RgbdFrame& frame,
                                                       const cv::Mat1b& excluded) const;

  DepthFilterConfig depth_;
  ExclusionConfig exclusion_;
  CameraModel camera_;                 // that rays_ belongs to
  std::vector<Eigen::Vector2f> rays_;  // x/z and y/z of each pixel, row by row
  cv::Mat1b without_ray_;              // 255 where the camera model gives none that can be used
};

}  // namespace tsg
