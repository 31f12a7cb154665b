#include "common/simulation/camera/camera_path.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <utility>

#include "common/dataset/trajectory.hpp"
#include "common/render/preview.hpp"
#include "common/simulation/random.hpp"

namespace tsg::simulation {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;
constexpr int kTremorWaves = 12;

/// What a waypoint interpolates: position, target, roll.
using Knot = Eigen::Matrix<double, 7, 1>;

Knot knot_of(const CameraWaypoint& waypoint) {
  Knot knot;
  knot << waypoint.position_m, waypoint.look_at_m, waypoint.roll_rad;
  return knot;
}

/// Speed at a waypoint: between its neighbours, as a Catmull-Rom curve of uneven times has it.
Knot speed_at(const std::vector<CameraWaypoint>& waypoints, std::size_t i) {
  if (i == 0 || i + 1 == waypoints.size()) return Knot::Zero();
  const double span_s = waypoints[i + 1].at_s - waypoints[i - 1].at_s;
  return (knot_of(waypoints[i + 1]) - knot_of(waypoints[i - 1])) / span_s;
}

SE3 pose_of(const Knot& knot) {
  const SE3 T_world_level = render::look_at(knot.head<3>(), knot.segment<3>(3));
  const Eigen::AngleAxisd roll(knot[6], Eigen::Vector3d::UnitZ());
  return T_world_level * SE3(Eigen::Quaterniond(roll), Eigen::Vector3d::Zero());
}

}  // namespace

Expected<CameraPath> CameraPath::make(const CameraPathDescription& description,
                                      std::uint64_t seed) {
  CameraPath path;
  path.waypoints_ = description.waypoints;
  if (!description.trajectory_file.empty()) {
    auto trajectory = read_trajectory(description.trajectory_file);
    if (!trajectory) return tl::unexpected(trajectory.error());
    path.recorded_ = std::move(*trajectory);
  }
  if (path.waypoints_.empty() && path.recorded_.empty()) {
    return make_error(ExitCode::kBadData,
                      "the camera has neither waypoints nor a trajectory; give it a waypoint");
  }
  path.tremor_ = make_tremor(description, seed);
  return path;
}

std::vector<CameraPath::Wave> CameraPath::make_tremor(const CameraPathDescription& description,
                                                      std::uint64_t seed) {
  Random random(seed_of(seed, "tremor"));
  std::vector<Wave> waves;
  Vector6d squares = Vector6d::Zero();
  for (int i = 0; i < kTremorWaves; ++i) {
    Wave wave{.turns_per_s = random.uniform(0.4, 7.0), .phase_rad = random.uniform(0.0, kTurn)};
    // Hands shake less at high frequencies.
    const double strength = 1.0 / (1.0 + 0.3 * wave.turns_per_s);
    for (double& amplitude : wave.amplitude) amplitude = strength * random.normal();
    squares += wave.amplitude.cwiseAbs2();
    waves.push_back(wave);
  }
  Vector6d deviation;
  deviation << Eigen::Vector3d::Constant(description.tremor_position_m),
      Eigen::Vector3d::Constant(description.tremor_rotation_rad);
  // The waves' powers add up; a sine's standard deviation is its amplitude / sqrt(2).
  const Vector6d scale = std::sqrt(2.0) * deviation.cwiseQuotient(squares.cwiseSqrt());
  for (Wave& wave : waves) wave.amplitude = wave.amplitude.cwiseProduct(scale);
  return waves;
}

SE3 CameraPath::T_world_camera(double time_s) const {
  Vector6d tremor = Vector6d::Zero();
  for (const Wave& wave : tremor_) {
    tremor += wave.amplitude * std::sin(kTurn * wave.turns_per_s * time_s + wave.phase_rad);
  }
  return (recorded_.empty() ? smooth_pose(time_s) : recorded_pose(time_s)) * SE3::exp(tremor);
}

SE3 CameraPath::smooth_pose(double time_s) const {
  const auto after = std::ranges::upper_bound(waypoints_, time_s, {}, &CameraWaypoint::at_s);
  if (after == waypoints_.begin()) return pose_of(knot_of(waypoints_.front()));
  if (after == waypoints_.end()) return pose_of(knot_of(waypoints_.back()));
  const auto to = static_cast<std::size_t>(std::distance(waypoints_.begin(), after));
  const std::size_t from = to - 1;
  const double span_s = waypoints_[to].at_s - waypoints_[from].at_s;
  const double s = (time_s - waypoints_[from].at_s) / span_s;
  // Cubic Hermite curve.
  const double s2 = s * s;
  const double s3 = s2 * s;
  const Knot knot = (2 * s3 - 3 * s2 + 1) * knot_of(waypoints_[from]) +
                    (s3 - 2 * s2 + s) * span_s * speed_at(waypoints_, from) +
                    (3 * s2 - 2 * s3) * knot_of(waypoints_[to]) +
                    (s3 - s2) * span_s * speed_at(waypoints_, to);
  return pose_of(knot);
}

SE3 CameraPath::recorded_pose(double time_s) const {
  const std::int64_t stamp_ns =
      recorded_.front().stamp_ns + static_cast<std::int64_t>(std::llround(time_s * 1e9));
  const auto after = std::ranges::upper_bound(recorded_, stamp_ns, {}, &StampedPose::stamp_ns);
  if (after == recorded_.begin()) return recorded_.front().T_world_camera;
  if (after == recorded_.end()) return recorded_.back().T_world_camera;
  const StampedPose& from = *std::prev(after);
  const double share = static_cast<double>(stamp_ns - from.stamp_ns) /
                       static_cast<double>(after->stamp_ns - from.stamp_ns);
  const SE3& T_world_a = from.T_world_camera;
  const SE3& T_world_b = after->T_world_camera;
  return {T_world_a.rotation().slerp(share, T_world_b.rotation()),
          (1.0 - share) * T_world_a.translation() + share * T_world_b.translation()};
}

}  // namespace tsg::simulation
