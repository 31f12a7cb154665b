#include "services/tsgctl/run/accuracy.hpp"

#include <string>
#include <utility>

#include "common/dataset/evaluation.hpp"

namespace tsg {
namespace {

/// RPE over a second, as papers give it; over a frame where the sequence is shorter than that.
std::optional<std::pair<RelativeError, std::string>> relative_error_of(const Trajectory& truth,
                                                                       const Trajectory& estimate) {
  if (auto error = relative_error(truth, estimate, {.delta = 1.0, .unit = DeltaUnit::kSeconds})) {
    return std::pair(*error, "1 s");
  }
  if (auto error = relative_error(truth, estimate, {.delta = 1.0, .unit = DeltaUnit::kFrames})) {
    return std::pair(*error, "1 frame");
  }
  return std::nullopt;
}

}  // namespace

std::optional<TrajectoryAccuracy> measure_accuracy(const Trajectory& truth,
                                                   const Trajectory& estimate) {
  const auto ate = absolute_error(truth, estimate);
  const auto rpe = relative_error_of(truth, estimate);
  if (!ate || !rpe) return std::nullopt;
  return TrajectoryAccuracy{.ate_m = ate->translation_m,
                            .rpe_translation_m = rpe->first.translation_m,
                            .rpe_rotation_deg = rpe->first.rotation_deg,
                            .rpe_delta = rpe->second};
}

std::optional<TrajectoryAccuracy> measure_accuracy(const Trajectory& truth,
                                                   const std::filesystem::path& estimate) {
  const auto trajectory = read_trajectory(estimate);
  if (!trajectory) return std::nullopt;
  return measure_accuracy(truth, *trajectory);
}

}  // namespace tsg
