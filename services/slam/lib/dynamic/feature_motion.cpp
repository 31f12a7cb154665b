#include "services/slam/lib/dynamic/feature_motion.hpp"

#include <algorithm>
#include <cmath>

#include "services/slam/lib/feature_matcher.hpp"
#include "services/slam/lib/nearest_depth.hpp"

namespace tsg {
namespace {

constexpr float kReach = 32.0F;            // pixels that a thing may have moved by in the image
constexpr float kDepthReach = 0.2F;        // 1/m
constexpr double kMovedPixels = 3.0;       // beyond noise, pose error, and what a corner wanders
constexpr double kMovedDepthSigmas = 6.0;  // of inverse depth, where the corner stays in place
constexpr float kStillReach = 4.0F;        // pixels: what is found here needs no other explanation
constexpr MatchLimits kStillLimits{.max_distance = 70, .max_ratio = 0.95F};
constexpr MatchLimits kMovedLimits{.max_distance = 50, .max_ratio = 0.8F};

constexpr float kNeighbourhood = 40.0F;       // pixels
constexpr float kLikeDepth = 0.08F;           // share of inverse depth
constexpr float kInverseDepthScale = 400.0F;  // pixels per 1/m: 1 % of a metre off at 1 m weighs 4
constexpr float kAlikePixels = 4.0F;
constexpr float kAlikeShare = 0.3F;     // of the shift: things turn, too
constexpr int kMinCompany = 4;          // moved neighbours, itself included
constexpr double kMinMovedShare = 0.6;  // of the neighbours that were tested

std::vector<MatchTarget> lay_over(const ObservationModel& model,
                                  const Features& from,
                                  const SE3& T_now_then) {
  std::vector<MatchTarget> targets;
  targets.reserve(from.size());
  for (std::size_t i = 0; i < from.size(); ++i) {
    const Feature& feature = from.items[i];
    if (!feature.has_depth()) continue;
    const Eigen::Vector3d p_then =
        model.camera().unproject(feature.pixel.cast<double>(), 1.0 / feature.inverse_depth);
    const Eigen::Vector3d p_now = T_now_then * p_then;
    if (p_now.z() < kMinDepth) continue;
    const Eigen::Vector2d pixel = model.camera().project(p_now);
    if (!model.camera().contains(pixel)) continue;
    targets.push_back({.source = static_cast<int>(targets.size()),
                       .pixel = pixel.cast<float>(),
                       .radius = kStillReach,
                       .inverse_depth = static_cast<float>(1.0 / p_now.z()),
                       .max_depth_error = kDepthReach,
                       .min_level = std::max(0, feature.level - 1),
                       .max_level = feature.level + 1,
                       .angle = feature.angle,
                       .descriptor = &from.descriptors[i]});
  }
  return targets;
}

FeatureMotion judge(const ObservationModel& model,
                    const Feature& seen,
                    const MatchTarget& expected) {
  FeatureMotion found{.motion = Motion::kStill};
  found.shift.head<2>() = seen.pixel - expected.pixel;
  double depth_miss = 0.0;
  if (seen.has_depth()) {
    const float difference = seen.inverse_depth - expected.inverse_depth;
    depth_miss = std::abs(difference);
    found.shift.z() = kInverseDepthScale * difference;
  }
  const double scale = model.level_scale(seen.level);
  const double depth_noise = std::sqrt(2.0) * model.inverse_depth_sigma();
  if (found.shift.head<2>().norm() > kMovedPixels * scale ||
      depth_miss > kMovedDepthSigmas * depth_noise) {
    found.motion = Motion::kMoved;
  }
  return found;
}

bool is_like(const Feature& a, const Feature& b) {
  if ((a.pixel - b.pixel).cwiseAbs().maxCoeff() > kNeighbourhood) return false;
  if (!a.has_depth() || !b.has_depth()) return true;
  return std::abs(a.inverse_depth - b.inverse_depth) <= kLikeDepth * a.inverse_depth;
}

/// Neighbours of what moves that could not be tested, where none was seen to stand still.
void take_along(const Features& features,
                const std::vector<FeatureMotion>& motion,
                std::vector<bool>& moving) {
  const std::vector<bool> tested = moving;
  for (std::size_t i = 0; i < features.size(); ++i) {
    if (motion[i].motion == Motion::kStill || tested[i]) continue;
    int moved = 0;
    int others = 0;
    features.grid.for_each_near(features.items[i].pixel, kNeighbourhood, [&](int index) {
      const auto k = static_cast<std::size_t>(index);
      if (motion[k].motion == Motion::kUnknown) return;
      if (!is_like(features.items[i], features.items[k])) return;
      ++(tested[k] ? moved : others);
    });
    moving[i] = moved >= kMinCompany && moved >= kMinMovedShare * (moved + others);
  }
}

}  // namespace

std::vector<FeatureMotion> compare_features(const ObservationModel& model,
                                            const FeatureView& now,
                                            const FeatureView& then) {
  const SE3 T_now_then = now.T_world_camera.inverse() * then.T_world_camera;
  auto targets = lay_over(model, then.features, T_now_then);
  std::vector<FeatureMotion> motion(now.features.size(), FeatureMotion{});
  std::vector<bool> explained(now.features.size(), false);
  const auto take = [&](const std::vector<FeatureMatch>& matches) {
    for (const FeatureMatch& match : matches) {
      const auto i = static_cast<std::size_t>(match.feature);
      MatchTarget& target = targets[static_cast<std::size_t>(match.source)];
      motion[i] = judge(model, now.features.items[i], target);
      explained[i] = true;
      target.descriptor = nullptr;
    }
  };
  take(match_by_projection(now.features, targets, {}, kStillLimits));
  std::erase_if(targets, [](const MatchTarget& target) { return target.descriptor == nullptr; });
  for (std::size_t i = 0; i < targets.size(); ++i) {
    targets[i].source = static_cast<int>(i);
    targets[i].radius = kReach;
  }
  take(match_by_projection(now.features, targets, explained, kMovedLimits));
  return motion;
}

bool moved_alike(const FeatureMotion& a, const FeatureMotion& b) {
  const float allowed = kAlikePixels + kAlikeShare * std::max(a.shift.norm(), b.shift.norm());
  return (a.shift - b.shift).norm() <= allowed;
}

std::vector<bool> moving_in_company(const Features& features,
                                    const std::vector<FeatureMotion>& motion) {
  std::vector<bool> moving(features.size(), false);
  for (std::size_t i = 0; i < features.size(); ++i) {
    if (motion[i].motion != Motion::kMoved) continue;
    int alike = 0;
    int others = 0;
    features.grid.for_each_near(features.items[i].pixel, kNeighbourhood, [&](int index) {
      const auto k = static_cast<std::size_t>(index);
      if (motion[k].motion == Motion::kUnknown) return;
      if (!is_like(features.items[i], features.items[k])) return;
      const bool goes_along =
          motion[k].motion == Motion::kMoved && moved_alike(motion[i], motion[k]);
      ++(goes_along ? alike : others);
    });
    moving[i] = alike >= kMinCompany && alike >= kMinMovedShare * (alike + others);
  }
  take_along(features, motion, moving);
  return moving;
}

}  // namespace tsg
