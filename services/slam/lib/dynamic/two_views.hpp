#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>

#include "services/slam/lib/dynamic/pixel_pair.hpp"

namespace tsg {

/// What holds in two images for all that does not move.
struct TwoViews {
  /// The fundamental matrix F; nothing where the camera stood still, only turned, or saw one plane.
  /// F is arbitrary then: each line through H p1 is as good an epipolar line as any.
  std::optional<Eigen::Matrix3d> F;
  Eigen::Matrix3d H;  ///< used without F: what does not move is seen at H p1

  /// Of p2 from where it may be if it does not move, pixels: a line with F, else a point.
  [[nodiscard]] double distance(const PixelPair& pair) const;
  /// Noise makes distance() exceed this as often as it makes the distance from a line exceed
  /// `max_distance_px`: a point is missed in two directions.
  [[nodiscard]] double limit(double max_distance_px) const;
};

/// F or H from pairs of which most do not move, whichever explains them with less: Torr's geometric
/// robust information criterion (1998). `max_distance_px` is what 95 % of them keep below.
/// Nothing for fewer than eight pairs or ones that determine neither (pixels on a line).
/// Where few of the pairs (below some 20 %) lie off a plane that all others lie on, H wins, and
/// what lies off the plane counts as moving: rather a feature less than a moving one kept.
[[nodiscard]] std::optional<TwoViews> estimate_two_views(std::span<const PixelPair> pairs,
                                                         double max_distance_px);

}  // namespace tsg
