#pragma once

// For tests: tracking and mapping along a short path through a rendered scene, and the map of it.

#include <utility>

#include "services/slam/lib/local_mapper.hpp"
#include "services/slam/lib/map_contents.hpp"
#include "services/slam/lib/synthetic_scene.hpp"
#include "services/slam/lib/tracker.hpp"

namespace tsg::synthetic {

inline SE3 on_path(int i) { return pose_at(0.02 * i, 0.005 * i, 0.01 * i, 0.006 * i); }

/// Tracking and mapping in turn.
class Session {
 public:
  explicit Session(const SlamConfig& config = {})
      : tracker_(config, camera()), mapper_(config, camera()) {}
  Session(const SlamConfig& config, MapContents&& contents)
      : tracker_(config, contents.camera), mapper_(config, std::move(contents)) {}

  TrackResult step(const RgbdFrame& frame) {
    const auto features = tracker_.extract(frame, nullptr);
    TrackResult result = tracker_.track(features, *mapper_.snapshot());
    if (result.state == TrackingState::kLost) mapper_.recall(*features);
    mapper_.remove_points(result.dynamic_points);
    if (result.keyframe) {
      mapper_.insert(KeyframeCandidate(*result.keyframe));
      mapper_.refine({});
    }
    return result;
  }
  LocalMapper& mapper() { return mapper_; }

 private:
  Tracker tracker_;
  LocalMapper mapper_;
};

inline const Scene& room() {
  static const Scene kRoom = Scene::room();
  return kRoom;
}

inline void walk(Session& session, int from, int to) {
  for (int i = from; i < to; ++i) {
    session.step(room().render(static_cast<std::uint64_t>(i), on_path(i)));
  }
}

/// A small map of real features.
inline const MapContents& example_map() {
  static const MapContents kContents = [] {
    Session session;
    walk(session, 0, 20);
    return session.mapper().contents();
  }();
  return kContents;
}

/// The same with all else that a map can have.
inline MapContents map_with_everything() {
  MapContents contents = example_map();
  const KeyframeId shift = contents.newest;
  contents.loops.push_back({contents.keyframes.front().id, contents.newest, on_path(3)});
  // Room for culled keyframes between those that are there.
  contents.keyframes.back().id = contents.newest = shift + 2;
  for (MapPoint& point : contents.points) {
    for (Observation& seen : point.observations) {
      if (seen.keyframe == shift) seen.keyframe = shift + 2;
    }
  }
  contents.loops.back().b = contents.newest;
  contents.culled[shift + 1] = {contents.newest, on_path(1), 71, 72};
  contents.culled[shift] = {shift + 1, on_path(2), 61, 62};
  contents.keyframes.front().banned[4] = contents.keyframes.front().points[4] == kNoPoint;
  contents.is_adjusting = true;
  return contents;
}

}  // namespace tsg::synthetic
