#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "common/geometry/se3.hpp"

namespace tsg {

/// Poses that hang together by what is known of pairs of them.
struct PoseGraph {
  struct Node {
    SE3 T_world_camera;
    bool fixed = false;  ///< at least one must be
  };
  struct Edge {
    std::size_t a = 0;
    std::size_t b = 0;
    SE3 T_a_b;                        ///< as known
    double translation_weight = 1.0;  ///< 1 / standard deviation, 1/m
    double rotation_weight = 1.0;     ///< 1/rad
  };
  std::vector<Node> nodes;
  std::vector<Edge> edges;
};

/// Finds the poses that fit all edges best (least squares over SE(3), Ceres with analytic
/// derivatives, one thread), in place. `must_stop` (may be empty) is asked after each iteration.
/// False, and the poses as they were, where there is no solution or it was stopped: half a
/// correction would tear the map.
[[nodiscard]] bool relax(PoseGraph& graph, const std::function<bool()>& must_stop = {});

using Matrix66 = Eigen::Matrix<double, 6, 6>;

/// Takes twists seen from b to twists seen from a.
[[nodiscard]] Matrix66 adjoint(const SE3& T_a_b);

/// Derivative of log(exp(xi) * exp(twist)) by xi at 0, to a relative error of 1e-6 for rotations
/// up to one radian (series of the Bernoulli numbers, Barfoot 2017, 7.1.5).
[[nodiscard]] Matrix66 inverse_left_jacobian(const Vector6d& twist);

}  // namespace tsg
