#include "common/simulation/people/stage_props.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "common/core/check.hpp"
#include "common/simulation/people/route.hpp"

namespace tsg::simulation {
namespace {

constexpr double kClearanceM = 0.28;  // half a body's width, kept from what one goes around

/// Whether the line from `a` to `b` enters the box -half..half (slab method).
bool crosses_box(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& half) {
  double enters = 0.0;
  double leaves = 1.0;
  for (Eigen::Index axis = 0; axis < 2; ++axis) {
    const double way = b[axis] - a[axis];
    if (std::abs(way) < 1e-9) {
      if (std::abs(a[axis]) >= half[axis]) return false;
      continue;
    }
    const double first = (-half[axis] - a[axis]) / way;
    const double second = (half[axis] - a[axis]) / way;
    enters = std::max(enters, std::min(first, second));
    leaves = std::min(leaves, std::max(first, second));
  }
  return enters < leaves;
}

}  // namespace

FloorPose PlannedProp::floor_pose() const {
  const Eigen::Vector3d front = T_world_now.rotation() * Eigen::Vector3d::UnitX();
  return {T_world_now.translation().head<2>(), std::atan2(front.y(), front.x())};
}

double PlannedProp::half_extent_m(double direction_rad) const {
  const double angle = direction_rad - floor_pose().yaw_rad;
  return std::abs(std::cos(angle)) * prop.half_size_m.x() +
         std::abs(std::sin(angle)) * prop.half_size_m.y();
}

PropStage::PropStage(const std::map<std::string, Prop>& props) {
  for (const auto& [name, prop] : props) {
    props_.push_back({name, prop, prop.T_world_object, 0.0, 0, {}});
  }
}

std::size_t PropStage::index_of(const std::string& name) const {
  const auto found = std::lower_bound(
      props_.begin(), props_.end(), name,
      [](const PlannedProp& prop, const std::string& wanted) { return prop.name < wanted; });
  TSG_CHECK(found != props_.end() && found->name == name);
  return static_cast<std::size_t>(found - props_.begin());
}

double PropStage::support_z_m(const Eigen::Vector2d& place_m, std::size_t except) const {
  double height_m = 0.0;
  for (std::size_t i = 0; i < props_.size(); ++i) {
    const PlannedProp& candidate = props_[i];
    if (i == except || candidate.prop.top_m <= 0.0) continue;
    const FloorPose pose = candidate.floor_pose();
    const Eigen::Vector2d inside = Eigen::Rotation2Dd(-pose.yaw_rad) * (place_m - pose.position_m);
    const bool is_over = (inside.cwiseAbs() - candidate.prop.half_size_m).maxCoeff() <= 0.0;
    if (is_over) height_m = std::max(height_m, candidate.base_z_m() + candidate.prop.top_m);
  }
  return height_m;
}

std::vector<Eigen::Vector2d> way_around(const PlannedProp& prop,
                                        const Eigen::Vector2d& from_m,
                                        const Eigen::Vector2d& to_m) {
  const FloorPose pose = prop.floor_pose();
  const Eigen::Rotation2Dd R_world_prop(pose.yaw_rad);
  const Eigen::Vector2d from = R_world_prop.inverse() * (from_m - pose.position_m);
  const Eigen::Vector2d to = R_world_prop.inverse() * (to_m - pose.position_m);
  const Eigen::Vector2d half = prop.prop.half_size_m + Eigen::Vector2d::Constant(kClearanceM);
  // Who stands nearer than that already goes straight away.
  const Eigen::Vector2d kept =
      (0.9 * half).cwiseMin(0.95 * from.cwiseAbs().cwiseMax(to.cwiseAbs().cwiseMin(half)));
  if (!crosses_box(from, to, kept)) return {};
  const double side = from.y() + to.y() >= 0.0 ? 1.0 : -1.0;
  std::array<Eigen::Vector2d, 2> corners{
      Eigen::Vector2d(std::copysign(half.x(), from.x()), side * half.y()),
      Eigen::Vector2d(std::copysign(half.x(), to.x()), side * half.y())};
  std::vector<Eigen::Vector2d> result;
  for (const Eigen::Vector2d& corner : corners) {
    const Eigen::Vector2d in_world = pose.position_m + R_world_prop * corner;
    if (result.empty() || (result.back() - in_world).norm() > 0.05) result.push_back(in_world);
  }
  return result;
}

}  // namespace tsg::simulation
