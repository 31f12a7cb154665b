#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <string>
#include <vector>

#include "common/geometry/se3.hpp"
#include "services/map_server/lib/keyframe_view.hpp"

namespace tsg::test {

/// Points 1 cm apart on the faces of a box (map frame), each standing for a pixel.
inline Cloud surface_of(const Eigen::Vector3f& low, const Eigen::Vector3f& high) {
  constexpr float kStep_m = 0.01F;
  const Eigen::Vector3f size = high - low;
  const Eigen::Vector3i steps = (size / kStep_m).array().round().cast<int>();
  Cloud cloud;
  for (int x = 0; x <= steps.x(); ++x) {
    for (int y = 0; y <= steps.y(); ++y) {
      for (int z = 0; z <= steps.z(); ++z) {
        const bool is_inside =
            x > 0 && x < steps.x() && y > 0 && y < steps.y() && z > 0 && z < steps.z();
        if (is_inside) continue;
        const Eigen::Vector3f offset =
            kStep_m * Eigen::Vector3f(float(x) + 0.5F, float(y) + 0.5F, float(z) + 0.5F);
        cloud.push_back({low + offset, {200, 100, 50}, 57, 1});
      }
    }
  }
  return cloud;
}

/// What one keyframe shows: a thing of a class, with its points in the map frame.
struct Shown {
  std::string class_name;
  Cloud points;
  std::uint32_t track_id = 0;
  MotionVerdict motion = MotionVerdict::kStatic;
  float score = 0.9F;
};

/// At the map's origin, 1 m up, looking along x.
inline SE3 camera_pose() {
  Eigen::Matrix3d R_world_camera;
  R_world_camera << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  return {R_world_camera, {0.0, 0.0, 1.0}};
}

/// The keyframe that shows these things from camera_pose(), before a wall 4.5 m ahead.
inline KeyframeView view_of(std::uint64_t id, const std::vector<Shown>& things) {
  const Eigen::Isometry3f T_camera_world = camera_pose().inverse().to_isometry().cast<float>();
  KeyframeView view;
  view.id = id;
  view.stamp_ns = static_cast<std::int64_t>(id) * 1'000'000'000;
  view.has_labels = true;
  for (const Shown& thing : things) {
    view.instances.push_back(
        {{thing.class_name, thing.score, {}, thing.motion, thing.track_id}, thing.points});
    for (CloudPoint& point : view.instances.back().points) {
      point.position = T_camera_world * point.position;
    }
  }
  for (float y = -2.5F; y <= 2.5F; y += 0.2F) {
    for (float z = -1.0F; z <= 3.0F; z += 0.2F) {
      view.points.push_back({T_camera_world * Eigen::Vector3f(4.5F, y, z), {}, 0, 1});
    }
  }
  return view;
}

}  // namespace tsg::test
