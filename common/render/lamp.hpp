#pragma once

#include <Eigen/Core>

namespace tsg::render {

/// A rectangle that gives light: a lamp panel or a window.
struct Lamp {
  Eigen::Vector3f centre_m;
  Eigen::Vector3f half_side_a_m;
  Eigen::Vector3f half_side_b_m;
  Eigen::Vector3f normal;        ///< where it shines
  Eigen::Vector3f radiance_bgr;  ///< linear light

  [[nodiscard]] float area_m2() const { return 4.0F * half_side_a_m.cross(half_side_b_m).norm(); }
};

}  // namespace tsg::render
