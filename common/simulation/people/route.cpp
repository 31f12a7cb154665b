#include "common/simulation/people/route.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "common/simulation/people/easing.hpp"

namespace tsg::simulation {
namespace {

constexpr double kBiggestRadiusM = 0.6;
constexpr double kAcceleration = 1.3;    // m/s^2, mean of speeding up and slowing down
constexpr double kSharpCornerRad = 2.1;  // walked to, turned at, walked on from
constexpr double kTurnWithinM = 0.7;     // of the path: from the first yaw into its direction
constexpr double kLookAheadM = 0.25;     // a body turns into a bend before its feet do
constexpr double kFeetTurnM = 0.35;      // way of the feet per radian turned in place

Eigen::Vector2d direction_of(double yaw_rad) { return {std::cos(yaw_rad), std::sin(yaw_rad)}; }

/// Leaves out corners that are nearer than 2 cm to the one before.
std::vector<Eigen::Vector2d> without_repeats(const std::vector<Eigen::Vector2d>& corners) {
  std::vector<Eigen::Vector2d> result;
  for (const Eigen::Vector2d& corner : corners) {
    if (result.empty() || (corner - result.back()).norm() > 0.02) result.push_back(corner);
  }
  return result;
}

}  // namespace

double heading_between(const Eigen::Vector2d& from_m, const Eigen::Vector2d& to_m) {
  return std::atan2(to_m.y() - from_m.y(), to_m.x() - from_m.x());
}

std::vector<std::vector<Eigen::Vector2d>> walkable_parts(
    const std::vector<Eigen::Vector2d>& corners_m) {
  const std::vector<Eigen::Vector2d> corners = without_repeats(corners_m);
  if (corners.size() < 2) return {};
  std::vector<std::vector<Eigen::Vector2d>> parts(1);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    parts.back().push_back(corners[i]);
    if (i == 0 || i + 1 == corners.size()) continue;
    const double turn = wrapped(heading_between(corners[i], corners[i + 1]) -
                                heading_between(corners[i - 1], corners[i]));
    if (std::abs(turn) > kSharpCornerRad) parts.push_back({corners[i]});
  }
  return parts;
}

SE3 to_transform(const FloorPose& pose) {
  return {Eigen::Quaterniond(Eigen::AngleAxisd(pose.yaw_rad, Eigen::Vector3d::UnitZ())),
          {pose.position_m.x(), pose.position_m.y(), 0.0}};
}

Eigen::Vector2d moved_by(const FloorPose& pose, const Eigen::Vector2d& offset_m) {
  return pose.position_m + Eigen::Rotation2Dd(pose.yaw_rad) * offset_m;
}

RoundedPath::RoundedPath(const std::vector<Eigen::Vector2d>& corners) : end_m_(corners.front()) {
  double heading = heading_between(corners[0], corners[1]);
  double cut_m = 0.0;  // of the present leg by the arc at its beginning
  for (std::size_t i = 0; i + 1 < corners.size(); ++i) {
    const double leg_m = (corners[i + 1] - corners[i]).norm();
    if (i + 2 == corners.size()) {
      add(heading, 0.0, leg_m - cut_m);
      break;
    }
    const Eigen::Vector2d next = corners[i + 2] - corners[i + 1];
    const double turn = wrapped(heading_between(corners[i + 1], corners[i + 2]) - heading);
    const double tangent = std::tan(0.5 * std::abs(turn));
    const double next_cut_m = std::min({kBiggestRadiusM * tangent, 0.5 * leg_m, 0.5 * next.norm()});
    add(heading, 0.0, leg_m - cut_m - next_cut_m);
    if (next_cut_m > 1e-6) {
      const double radius = next_cut_m / tangent;
      add(heading, (turn > 0.0 ? 1.0 : -1.0) / radius, radius * std::abs(turn));
    }
    heading += turn;
    cut_m = next_cut_m;
  }
}

void RoundedPath::add(double heading_rad, double curvature, double length_m) {
  if (length_m <= 1e-9) return;
  pieces_.push_back({end_m_, heading_rad, curvature, length_m_, length_m});
  length_m_ += length_m;
  end_m_ = position_m(length_m_);
}

const RoundedPath::Piece& RoundedPath::piece_at(double along_m) const {
  std::size_t i = 0;
  while (i + 1 < pieces_.size() && pieces_[i + 1].begin_m <= along_m) ++i;
  return pieces_[i];
}

Eigen::Vector2d RoundedPath::position_m(double along_m) const {
  const double clamped = std::clamp(along_m, 0.0, length_m_);
  const Piece& piece = piece_at(clamped);
  const double way = clamped - piece.begin_m;
  if (piece.curvature == 0.0) return piece.from_m + way * direction_of(piece.heading_rad);
  const double angle = way * piece.curvature;
  const Eigen::Vector2d in_arc{std::sin(angle) / piece.curvature,
                               (1.0 - std::cos(angle)) / piece.curvature};
  return piece.from_m + Eigen::Rotation2Dd(piece.heading_rad) * in_arc;
}

double RoundedPath::direction_rad(double along_m) const {
  const double clamped = std::clamp(along_m, 0.0, length_m_);
  const Piece& piece = piece_at(clamped);
  return piece.heading_rad + (clamped - piece.begin_m) * piece.curvature;
}

double RoundedPath::heading_rad(double along_m) const {
  constexpr int kSamples = 8;
  double sum = 0.0;
  for (int i = -kSamples; i <= kSamples; ++i) {
    sum += direction_rad(along_m + kLookAheadM * i / kSamples);
  }
  return sum / (2 * kSamples + 1);
}

Route::Route(RoundedPath path, const Manner& manner)
    : path_{std::move(path)}, manner_(manner), length_m_(path_.front().length_m()) {
  const double heading = path_.front().heading_rad(0.0) + (manner.backwards ? kPi : 0.0);
  turn_rad_ = wrapped(manner.start_yaw_rad - heading);
}

Route::Route(const FloorPose& from, const FloorPose& to, double trailing_m)
    : from_(from),
      shift_m_(to.position_m - from.position_m),
      turn_rad_(wrapped(to.yaw_rad - from.yaw_rad)) {
  manner_.trailing_m = trailing_m;
  length_m_ = shift_m_.norm() + (kFeetTurnM + trailing_m) * std::abs(turn_rad_);
}

FloorPose Route::leader_at(double along_m) const {
  if (path_.empty()) {
    const double share = length_m_ > 0.0 ? std::clamp(along_m / length_m_, 0.0, 1.0) : 1.0;
    return {from_.position_m + share * shift_m_, from_.yaw_rad + share * turn_rad_};
  }
  const RoundedPath& path = path_.front();
  const double way_to_turn = std::min(kTurnWithinM + manner_.trailing_m, length_m_);
  const double still_to_turn = turn_rad_ * (1.0 - eased(along_m / way_to_turn));
  return {path.position_m(along_m),
          path.heading_rad(along_m) + (manner_.backwards ? kPi : 0.0) + still_to_turn};
}

FloorPose Route::person_at(double along_m) const {
  const FloorPose leader = leader_at(along_m);
  return {moved_by(leader, {-manner_.trailing_m, 0.0}), leader.yaw_rad};
}

SpeedProfile::SpeedProfile(double length_m, double speed_mps)
    : length_m_(length_m),
      speed_mps_(std::min(speed_mps, std::sqrt(std::max(length_m, 1e-9) * kAcceleration))),
      ramp_s_(speed_mps_ / kAcceleration),
      duration_s_(length_m_ / speed_mps_ + ramp_s_) {}

double SpeedProfile::along_m(double time_s) const {
  // The way of a speed that rises like eased(): its integral.
  const auto ramp = [this](double since_s) {
    const double u = since_s / ramp_s_;
    return speed_mps_ * ramp_s_ * u * u * u * (1.0 - 0.5 * u);
  };
  const double time = std::clamp(time_s, 0.0, duration_s_);
  if (time < ramp_s_) return ramp(time);
  if (time > duration_s_ - ramp_s_) return length_m_ - ramp(duration_s_ - time);
  return speed_mps_ * (time - 0.5 * ramp_s_);
}

}  // namespace tsg::simulation
