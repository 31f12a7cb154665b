#include "services/slam/lib/feature_matcher.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace tsg {
namespace {

constexpr int kRotationBins = 30;      // of 12 degrees
constexpr int kRotationPeaks = 3;      // neighbouring bins share a peak
constexpr double kMinPeakShare = 0.1;  // of the highest bin's count

struct Best {
  int feature = -1;
  int distance = std::numeric_limits<int>::max();
  int level = -1;
  int second_distance = std::numeric_limits<int>::max();
  int second_level = -1;

  void offer(int candidate, int candidate_distance, int candidate_level) {
    if (candidate_distance < distance) {
      second_distance = distance;
      second_level = level;
      feature = candidate;
      distance = candidate_distance;
      level = candidate_level;
    } else if (candidate_distance < second_distance) {
      second_distance = candidate_distance;
      second_level = candidate_level;
    }
  }

  [[nodiscard]] bool passes(const MatchLimits& limits) const {
    if (feature < 0 || distance > limits.max_distance) return false;
    return second_level != level ||
           static_cast<float>(distance) <= limits.max_ratio * static_cast<float>(second_distance);
  }
};

/// Whether the feature can be what the target looks for, by all but its descriptor.
bool fits(const Feature& feature, const MatchTarget& target) {
  return feature.level >= target.min_level && feature.level <= target.max_level &&
         std::abs(feature.pixel.x() - target.pixel.x()) <= target.radius &&
         std::abs(feature.pixel.y() - target.pixel.y()) <= target.radius &&
         (!feature.has_depth() ||
          std::abs(feature.inverse_depth - target.inverse_depth) <= target.max_depth_error);
}

/// Of several matches to one feature the closest stays. Sorted by feature.
std::vector<FeatureMatch> unique_features(const std::vector<int>& match_of_feature,
                                          const std::vector<FeatureMatch>& matches) {
  std::vector<FeatureMatch> unique;
  unique.reserve(matches.size());
  for (const int match : match_of_feature) {
    if (match >= 0) unique.push_back(matches[static_cast<std::size_t>(match)]);
  }
  return unique;
}

/// Collects matches; a feature goes to the target that it is closest to, the first on a tie.
class MatchCollector {
 public:
  explicit MatchCollector(std::size_t features) : match_of_feature_(features, -1) {}

  void add(const FeatureMatch& match) {
    int& holder = match_of_feature_[static_cast<std::size_t>(match.feature)];
    if (holder >= 0 && matches_[static_cast<std::size_t>(holder)].distance <= match.distance)
      return;
    holder = static_cast<int>(matches_.size());
    matches_.push_back(match);
  }
  [[nodiscard]] std::vector<FeatureMatch> take() const {
    return unique_features(match_of_feature_, matches_);
  }

 private:
  std::vector<int> match_of_feature_;
  std::vector<FeatureMatch> matches_;
};

std::size_t rotation_bin(float rotation) {
  const double turn = rotation / (2.0 * std::numbers::pi);
  const double fraction = turn - std::floor(turn);
  return static_cast<std::size_t>(std::lround(fraction * kRotationBins)) % kRotationBins;
}

}  // namespace

std::vector<FeatureMatch> match_by_projection(const Features& features,
                                              const std::vector<MatchTarget>& targets,
                                              const std::vector<bool>& taken,
                                              const MatchLimits& limits) {
  MatchCollector collector(features.size());
  for (const MatchTarget& target : targets) {
    Best best;
    features.grid.for_each_near(target.pixel, target.radius, [&](int index) {
      const auto i = static_cast<std::size_t>(index);
      if (!fits(features.items[i], target) || (!taken.empty() && taken[i])) return;
      best.offer(index, hamming_distance(*target.descriptor, features.descriptors[i]),
                 features.items[i].level);
    });
    if (!best.passes(limits)) continue;
    const float angle = features.items[static_cast<std::size_t>(best.feature)].angle;
    collector.add({target.source, best.feature, best.distance, angle - target.angle});
  }
  return collector.take();
}

std::vector<FeatureMatch> match_by_descriptor(const Features& from,
                                              const std::vector<bool>& usable,
                                              const Features& to,
                                              const MatchLimits& limits) {
  MatchCollector collector(to.size());
  for (std::size_t i = 0; i < from.size(); ++i) {
    if (!usable[i]) continue;
    Best best;
    for (std::size_t k = 0; k < to.size(); ++k) {
      // One level for all: the ratio test compares places, not scales.
      best.offer(static_cast<int>(k), hamming_distance(from.descriptors[i], to.descriptors[k]), 0);
    }
    if (!best.passes(limits)) continue;
    const float angle = to.items[static_cast<std::size_t>(best.feature)].angle;
    collector.add({static_cast<int>(i), best.feature, best.distance, angle - from.items[i].angle});
  }
  return collector.take();
}

void keep_consistent_rotations(std::vector<FeatureMatch>& matches) {
  std::array<int, kRotationBins> counts{};
  for (const FeatureMatch& match : matches) ++counts[rotation_bin(match.rotation)];
  std::array<int, kRotationBins> sorted = counts;
  std::sort(sorted.begin(), sorted.end(), std::greater<>());
  const double least =
      std::max(static_cast<double>(sorted[kRotationPeaks - 1]), kMinPeakShare * sorted.front());
  std::erase_if(matches, [&](const FeatureMatch& match) {
    return counts[rotation_bin(match.rotation)] < least;
  });
}

}  // namespace tsg
