#include <algorithm>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "services/slam/lib/map_encoding.hpp"

namespace tsg {
namespace {

template <typename Item>
bool is_ascending(const std::vector<Item>& items) {
  return std::adjacent_find(items.begin(), items.end(), [](const Item& a, const Item& b) {
           return a.id >= b.id;
         }) == items.end();
}

/// Looks up keyframes by their ids, and which of their features show a point.
class Checker {
 public:
  explicit Checker(const MapContents& contents) : contents_(contents) {
    for (const Keyframe& keyframe : contents.keyframes) {
      keyframes_[keyframe.id] = {&keyframe, std::vector<bool>(keyframe.features->size(), false)};
    }
  }

  [[nodiscard]] bool has_keyframe(KeyframeId id) const { return keyframes_.contains(id); }

  /// Whether each part of the map has the keyframe that began it.
  [[nodiscard]] bool have_parts_a_beginning() const {
    return std::ranges::all_of(contents_.keyframes, [this](const Keyframe& keyframe) {
      const auto first = keyframes_.find(keyframe.part);
      return first != keyframes_.end() && first->second.keyframe->part == keyframe.part;
    });
  }

  /// The reason why an observation cannot be; empty where it can.
  [[nodiscard]] std::string check(const MapPoint& point, const Observation& observation) {
    const auto text = [&](const char* what) {
      return "point " + std::to_string(point.id) + what + std::to_string(observation.keyframe);
    };
    const auto place = keyframes_.find(observation.keyframe);
    if (place == keyframes_.end()) return text(" is seen by a keyframe that is not there: ");
    auto& [keyframe, is_taken] = place->second;
    const auto feature = static_cast<std::size_t>(observation.feature);
    if (observation.feature < 0 || feature >= is_taken.size()) {
      return text(" is seen by a feature that is not there, in keyframe ");
    }
    if (keyframe->part != keyframes_.at(point.observations.front().keyframe).keyframe->part) {
      return text(" is seen from two parts of the map, one of them that of keyframe ");
    }
    if (is_taken[feature]) return text(" shares a feature with another, in keyframe ");
    if (keyframe->banned[feature]) return text(" is seen on something dynamic, in keyframe ");
    is_taken[feature] = true;
    return {};
  }

  /// Whether every culled keyframe leads to one that is there.
  [[nodiscard]] bool are_culled_anchored() const {
    std::unordered_set<KeyframeId> anchored;
    std::vector<KeyframeId> way;
    for (const auto& [id, culled] : contents_.culled) {
      if (has_keyframe(id)) return false;
      way = {id};
      while (!has_keyframe(way.back()) && !anchored.contains(way.back())) {
        const auto next = contents_.culled.find(way.back());
        // As many steps as there are keyframes lead in a circle.
        if (next == contents_.culled.end() || way.size() > contents_.culled.size()) return false;
        way.push_back(next->second.parent);
      }
      anchored.insert(way.begin(), way.end());
    }
    return true;
  }

 private:
  struct Entry {
    const Keyframe* keyframe = nullptr;
    std::vector<bool> is_taken;
  };
  const MapContents& contents_;
  std::unordered_map<KeyframeId, Entry> keyframes_;
};

std::string check_points(const MapContents& contents, Checker& checker) {
  for (const MapPoint& point : contents.points) {
    const auto& seen = point.observations;
    if (seen.empty()) return "point " + std::to_string(point.id) + " is seen by no keyframe";
    const bool are_sorted =
        std::adjacent_find(seen.begin(), seen.end(), [](const auto& a, const auto& b) {
          return a.keyframe >= b.keyframe;
        }) == seen.end();
    if (!are_sorted) return "the observations of a point are out of order";
    for (const Observation& observation : seen) {
      std::string problem = checker.check(point, observation);
      if (!problem.empty()) return problem;
    }
  }
  return {};
}

}  // namespace

std::string find_inconsistency(const MapContents& contents) {
  if (contents.keyframes.empty()) return "it has no keyframe";
  if (!is_ascending(contents.keyframes)) return "its keyframes are out of order";
  if (!is_ascending(contents.points)) return "its points are out of order";
  if (!contents.points.empty() && contents.points.back().id >= contents.next_point) {
    return "a point has an id that is not given yet";
  }
  Checker checker(contents);
  if (contents.keyframes.back().id != contents.newest ||
      (!contents.culled.empty() && contents.culled.rbegin()->first > contents.newest)) {
    return "its newest keyframe is not there, or not the newest";
  }
  if (!checker.have_parts_a_beginning())
    return "a part of the map lacks the keyframe that began it";
  if (!checker.are_culled_anchored()) return "a culled keyframe leads nowhere";
  for (const LoopEdge& loop : contents.loops) {
    if (!checker.has_keyframe(loop.a) || !checker.has_keyframe(loop.b) || loop.a == loop.b) {
      return "a loop joins keyframes that are not there";
    }
  }
  for (const PointId id : contents.recent_points) {
    if (id >= contents.next_point) return "a point on trial has an id that is not given yet";
  }
  return check_points(contents, checker);
}

}  // namespace tsg
