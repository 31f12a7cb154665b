#include "common/dataset/evaluation.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <utility>

#include "common/core/check.hpp"
#include "common/core/time.hpp"

namespace tsg {
namespace {

constexpr std::size_t kLeastPairs = 3;

std::vector<std::int64_t> stamps_of(const Trajectory& trajectory) {
  std::vector<std::int64_t> stamps;
  stamps.reserve(trajectory.size());
  for (const StampedPose& pose : trajectory) stamps.push_back(pose.stamp_ns);
  return stamps;
}

std::string text_of_ms(std::int64_t ns) {
  return std::to_string(std::lround(to_milliseconds(ns))) + " ms";
}

/// Takes positions of the estimate to those of the truth with the least sum of squares.
SE3 align(const std::vector<MatchedPose>& matched) {
  const auto count = static_cast<Eigen::Index>(matched.size());
  Eigen::Matrix3Xd truth(3, count);
  Eigen::Matrix3Xd estimate(3, count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const MatchedPose& pose = matched[static_cast<std::size_t>(i)];
    truth.col(i) = pose.T_world_truth.translation();
    estimate.col(i) = pose.T_estimate_camera.translation();
  }
  const Eigen::Matrix4d T = Eigen::umeyama(estimate, truth, false);
  return {Eigen::Matrix3d(T.topLeftCorner<3, 3>()), Eigen::Vector3d(T.topRightCorner<3, 1>())};
}

/// The matched pose closest to `delta_ns` after matched[from].
std::optional<std::size_t> find_after(const std::vector<MatchedPose>& matched,
                                      std::size_t from,
                                      std::int64_t delta_ns,
                                      std::int64_t max_difference_ns) {
  const std::int64_t wanted_ns = matched[from].stamp_ns + delta_ns;
  const auto not_before = std::lower_bound(
      matched.begin(), matched.end(), wanted_ns,
      [](const MatchedPose& pose, std::int64_t stamp) { return pose.stamp_ns < stamp; });
  const auto distance = [&](auto pose) { return std::abs(pose->stamp_ns - wanted_ns); };
  auto best = not_before;
  if (best == matched.end() ||
      (best != matched.begin() && distance(std::prev(best)) <= distance(best))) {
    --best;  // matched[from] exists, so there is one before the end
  }
  const auto index = static_cast<std::size_t>(best - matched.begin());
  if (index <= from || distance(best) > max_difference_ns) return std::nullopt;
  return index;
}

std::vector<StampPair> pairs_apart(const std::vector<MatchedPose>& matched,
                                   const RelativeErrorConfig& config) {
  std::vector<StampPair> pairs;
  const auto delta_ns = static_cast<std::int64_t>(std::llround(config.delta * 1e9));
  const auto frames = static_cast<std::size_t>(std::llround(config.delta));
  for (std::size_t i = 0; i < matched.size(); ++i) {
    if (config.unit == DeltaUnit::kFrames) {
      if (i + frames < matched.size()) pairs.push_back({i, i + frames});
    } else if (const auto j = find_after(matched, i, delta_ns, config.max_difference_ns)) {
      pairs.push_back({i, *j});
    }
  }
  return pairs;
}

Expected<void> check_delta(const RelativeErrorConfig& config) {
  const bool is_whole = config.delta == std::floor(config.delta);
  if (config.delta > 0.0 && config.delta < 1e6 &&
      (config.unit == DeltaUnit::kSeconds || is_whole)) {
    return {};
  }
  return make_error(ExitCode::kUsage,
                    "delta " + std::to_string(config.delta) +
                        " does not work: give a positive time in seconds or a whole number of "
                        "frames");
}

}  // namespace

Expected<std::vector<MatchedPose>> match_poses(const Trajectory& truth,
                                               const Trajectory& estimate,
                                               std::int64_t max_difference_ns) {
  const auto pairs = associate(stamps_of(estimate), stamps_of(truth), max_difference_ns);
  if (pairs.size() < kLeastPairs) {
    return make_error(ExitCode::kEmptyInput,
                      "only " + std::to_string(pairs.size()) +
                          " poses of the estimate have one of "
                          "the ground truth within " +
                          text_of_ms(max_difference_ns) +
                          "; check that both belong to the same recording and that stamps are in "
                          "seconds");
  }
  std::vector<MatchedPose> matched;
  matched.reserve(pairs.size());
  for (const StampPair& pair : pairs) {
    matched.push_back({estimate[pair.first].stamp_ns, truth[pair.second].T_world_camera,
                       estimate[pair.first].T_world_camera});
  }
  return matched;
}

Expected<AbsoluteError> absolute_error(const Trajectory& truth,
                                       const Trajectory& estimate,
                                       std::int64_t max_difference_ns) {
  auto matched = match_poses(truth, estimate, max_difference_ns);
  if (!matched) return tl::unexpected(matched.error());
  AbsoluteError result;
  result.T_world_estimate = align(*matched);
  for (const MatchedPose& pose : *matched) {
    const Eigen::Vector3d aligned = result.T_world_estimate * pose.T_estimate_camera.translation();
    result.errors_m.push_back((aligned - pose.T_world_truth.translation()).norm());
  }
  result.translation_m = summarise(result.errors_m);
  result.matched = std::move(*matched);
  return result;
}

Expected<RelativeError> relative_error(const Trajectory& truth,
                                       const Trajectory& estimate,
                                       const RelativeErrorConfig& config) {
  if (const auto usable = check_delta(config); !usable) return tl::unexpected(usable.error());
  const auto matched = match_poses(truth, estimate, config.max_difference_ns);
  if (!matched) return tl::unexpected(matched.error());
  std::vector<double> translations_m;
  std::vector<double> rotations_deg;
  for (const StampPair& pair : pairs_apart(*matched, config)) {
    const MatchedPose& from = (*matched)[pair.first];
    const MatchedPose& to = (*matched)[pair.second];
    const SE3 T_truth = from.T_world_truth.inverse() * to.T_world_truth;
    const SE3 T_estimate = from.T_estimate_camera.inverse() * to.T_estimate_camera;
    const SE3 T_error = T_truth.inverse() * T_estimate;
    translations_m.push_back(T_error.translation().norm());
    rotations_deg.push_back(T_error.angle() * 180.0 / std::numbers::pi);
  }
  if (translations_m.empty()) {
    return make_error(ExitCode::kEmptyInput,
                      "no two matched poses lie the given delta apart; choose a smaller delta or "
                      "count it in frames");
  }
  return RelativeError{summarise(translations_m), summarise(rotations_deg)};
}

double improvement_rate(double reference_error, double error) {
  TSG_CHECK(reference_error > 0.0);
  return (reference_error - error) / reference_error;
}

}  // namespace tsg
