#include "services/slam/lib/dynamic/motion_evidence.hpp"

#include <algorithm>
#include <cmath>

namespace tsg {
namespace {

constexpr int kEnoughFeatures = 5;  // tested; of fewer one wrong match is too much
constexpr int kEnoughCells = 30;    // tested
constexpr double kLimit = 3.0;      // of the log odds, so that a long rest is forgotten at once
constexpr double kBelieve = 0.5;    // log odds from which on it moves ...
constexpr double kForget = -0.5;    // ... and below which it has come to rest
constexpr double kStrong = 1.6;     // log odds per frame
constexpr double kWeak = 0.4;
constexpr double kRest = -0.12;  // a second at 30 Hz from kLimit to kForget

double share(int part, int rest) { return static_cast<double>(part) / std::max(1, part + rest); }

/// Log odds that features or cells, the `moved` share of which moved, lie on a moving thing.
double weigh(double moved, double surely, double hardly) {
  if (moved >= surely) return kStrong;
  return moved >= hardly ? kWeak : kRest;
}

}  // namespace

void MotionEvidence::add(const MotionCounts& counts) {
  const bool has_features = counts.features_moved + counts.features_still >= kEnoughFeatures;
  const bool has_cells = counts.cells_appeared + counts.cells_same >= kEnoughCells;
  if (!has_features && !has_cells) return;
  double change = kRest;
  if (has_features) {
    change = std::max(change, weigh(share(counts.features_moved, counts.features_still), 0.4, 0.2));
  }
  if (has_cells) {
    change = std::max(change, weigh(share(counts.cells_appeared, counts.cells_same), 0.15, 0.08));
  }
  log_odds_ = std::clamp(log_odds_ + change, -kLimit / 2.0, kLimit);
  if (log_odds_ >= kLimit) was_certain_ = true;
  if (log_odds_ >= kBelieve) is_moving_ = true;
  if (log_odds_ <= kForget) is_moving_ = false;
}

double MotionEvidence::probability() const { return 1.0 / (1.0 + std::exp(-log_odds_)); }

}  // namespace tsg
