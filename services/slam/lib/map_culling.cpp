#include "services/slam/lib/map_culling.hpp"

#include <algorithm>

namespace tsg {
namespace {

constexpr double kMinFoundShare = 0.25;
constexpr int kMinExpected = 8;  // frames; before that the share says nothing
constexpr KeyframeId kTrialKeyframes = 3;
constexpr std::size_t kMinObservations = 2;
constexpr int kOthers = 3;

bool is_bad(const MapPoint& point, KeyframeId newest) {
  if (point.expected >= kMinExpected && point.found < kMinFoundShare * point.expected) return true;
  return newest - point.created_in >= kTrialKeyframes - 1 &&
         point.observations.size() < kMinObservations;
}

int level_of(const Map& map, const Observation& observation) {
  return map.keyframe(observation.keyframe)
      .features->items[static_cast<std::size_t>(observation.feature)]
      .level;
}

/// Seen by enough other keyframes, at most one level coarser.
bool is_covered(const Map& map, const MapPoint& point, KeyframeId by_others_than) {
  const auto own = std::find_if(
      point.observations.begin(), point.observations.end(),
      [&](const Observation& observation) { return observation.keyframe == by_others_than; });
  const int level = level_of(map, *own);
  const auto others = std::count_if(
      point.observations.begin(), point.observations.end(), [&](const Observation& observation) {
        return observation.keyframe != by_others_than && level_of(map, observation) <= level + 1;
      });
  return others >= kOthers;
}

bool is_redundant(const Map& map, const MapperConfig& config, const Keyframe& keyframe) {
  int points = 0;
  int covered = 0;
  for (const PointId id : keyframe.points) {
    if (id == kNoPoint) continue;
    ++points;
    if (is_covered(map, *map.find_point(id), keyframe.id)) ++covered;
  }
  return covered >= config.redundant_share * points;
}

}  // namespace

void cull_recent_points(Map& map, KeyframeId newest, std::vector<PointId>& recent) {
  std::erase_if(recent, [&](PointId id) {
    const MapPoint* point = map.find_point(id);
    if (point == nullptr) return true;
    if (is_bad(*point, newest)) {
      map.remove_point(id);
      return true;
    }
    return newest - point->created_in >= kTrialKeyframes;
  });
}

std::optional<KeyframeId> find_redundant_keyframe(const Map& map,
                                                  const MapperConfig& config,
                                                  KeyframeId newest) {
  for (const Covisibility& neighbour : map.covisible_with(map.keyframe(newest))) {
    const Keyframe& keyframe = map.keyframe(neighbour.keyframe);
    if (part_begun_by(keyframe.id) == keyframe.part) continue;
    if (is_redundant(map, config, keyframe)) return keyframe.id;
  }
  return std::nullopt;
}

}  // namespace tsg
