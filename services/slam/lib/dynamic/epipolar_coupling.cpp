#include "services/slam/lib/dynamic/epipolar_coupling.hpp"

#include <limits>

#include "common/core/check.hpp"
#include "services/slam/lib/dynamic/two_views.hpp"
#include "services/slam/lib/feature_matcher.hpp"

namespace tsg {
namespace {

constexpr MatchLimits kLimits{.max_distance = 64, .max_ratio = 0.85F};

/// By looks and place alone: depth and motion of the features are what is to be judged.
std::vector<FeatureMatch> match(const Features& reference,
                                const Features& current,
                                float search_radius_px) {
  std::vector<MatchTarget> targets;
  targets.reserve(reference.size());
  for (std::size_t i = 0; i < reference.size(); ++i) {
    const Feature& feature = reference.items[i];
    targets.push_back({.source = static_cast<int>(i),
                       .pixel = feature.pixel,
                       .radius = search_radius_px,
                       .max_depth_error = std::numeric_limits<float>::infinity(),
                       .min_level = feature.level - 1,
                       .max_level = feature.level + 1,
                       .angle = feature.angle,
                       .descriptor = &reference.descriptors[i]});
  }
  auto matches = match_by_projection(current, targets, {}, kLimits);
  keep_consistent_rotations(matches);
  return matches;
}

/// The two ends of a match.
struct MatchedFeatures {
  const Feature& reference;
  const Feature& current;

  [[nodiscard]] PixelPair pixels() const {
    return {reference.pixel.cast<double>(), current.pixel.cast<double>()};
  }
  [[nodiscard]] bool is_static() const {
    return reference.verdict == FeatureVerdict::kStatic &&
           current.verdict == FeatureVerdict::kStatic;
  }
};

MatchedFeatures ends_of(const FeatureMatch& match,
                        const Features& reference,
                        const Features& current) {
  return {reference.items[static_cast<std::size_t>(match.source)],
          current.items[static_cast<std::size_t>(match.feature)]};
}

}  // namespace

CouplingVerdicts judge_by_epipolar_lines(const Features& reference,
                                         const Features& current,
                                         DynamicMethod method,
                                         const CouplingConfig& config) {
  TSG_CHECK(method == DynamicMethod::kTsg || method == DynamicMethod::kEpipolar);
  const bool by_class = method == DynamicMethod::kTsg;
  const auto matches = match(reference, current, static_cast<float>(config.search_radius_px));
  std::vector<PixelPair> believed;
  for (const FeatureMatch& match : matches) {
    const MatchedFeatures ends = ends_of(match, reference, current);
    if (!by_class || ends.is_static()) believed.push_back(ends.pixels());
  }

  CouplingVerdicts verdicts;
  verdicts.matches = static_cast<int>(matches.size());
  verdicts.epipolar_px.assign(current.size(), -1.0F);
  for (const Feature& feature : current.items) {
    verdicts.is_dynamic.push_back(by_class && feature.verdict != FeatureVerdict::kStatic);
  }
  const auto views = estimate_two_views(believed, config.threshold_px);
  if (!views) return verdicts;
  verdicts.fundamental = views->F;
  const double limit = views->limit(config.threshold_px);
  for (const FeatureMatch& match : matches) {
    const double distance = views->distance(ends_of(match, reference, current).pixels());
    const auto i = static_cast<std::size_t>(match.feature);
    verdicts.epipolar_px[i] = static_cast<float>(distance);
    verdicts.is_dynamic[i] = distance > limit;
  }
  return verdicts;
}

}  // namespace tsg
