#pragma once

// For tests: maps of rendered scenes with keyframes wherever, rightly or wrongly, a test says.

#include <memory>
#include <vector>

#include "services/slam/lib/depth_points.hpp"
#include "services/slam/lib/feature_extractor.hpp"
#include "services/slam/lib/point_fusion.hpp"
#include "services/slam/lib/synthetic_scene.hpp"

namespace tsg::synthetic {

class HandMadeMap {
 public:
  /// A keyframe that sees `scene` from `T_world_camera` and is put into the map at `T_map_camera`.
  /// Joined with the keyframe before it by the points that both see.
  const Keyframe& insert(const Scene& scene, const SE3& T_world_camera, const SE3& T_map_camera) {
    const KeyframeId id = map.keyframes().size();
    auto features =
        std::make_shared<const Features>(extractor_.extract(scene.render(id, T_world_camera), {}));
    Keyframe& keyframe = map.add_keyframe({.id = id,
                                           .features = features,
                                           .T_world_camera = T_map_camera,
                                           .points = std::vector(features->size(), kNoPoint),
                                           .banned = std::vector(features->size(), false)});
    if (id > 0) {
      std::vector<PointId> points = map.keyframe(id - 1).points;
      std::erase(points, kNoPoint);
      fuse_points_into(map, model, points, id, 3.0);
    }
    add_points_from_depth(map, model, keyframe);
    return keyframe;
  }

  SlamConfig config;
  ObservationModel model{camera(), config};
  Map map;

 private:
  FeatureExtractor extractor_{FeatureConfig{}, camera()};
};

}  // namespace tsg::synthetic
