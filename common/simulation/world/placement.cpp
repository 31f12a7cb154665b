#include "common/simulation/world/placement.hpp"

#include <algorithm>
#include <cstdint>
#include <map>
#include <utility>

#include "common/simulation/random.hpp"

namespace tsg::simulation {
namespace {

/// A model in the size that the scene asks for.
FurnitureModel model_of(const SceneDescription& scene, const ObjectDescription& object) {
  const std::uint64_t look = object.look != 0 ? object.look : seed_of(scene.seed, object.name);
  FurnitureModel model = make_furniture(object.type, look);
  const Eigen::Vector3d scale(object.scale[0], object.scale[1], object.scale[2]);
  if (scale == Eigen::Vector3d::Ones()) return model;
  for (Eigen::Vector3f& point : model.mesh.points) {
    point = point.cwiseProduct(scale.cast<float>());
  }
  for (Eigen::Vector3f& normal : model.mesh.normals) {
    normal = normal.cwiseQuotient(scale.cast<float>()).normalized();
  }
  model.top_m *= scale.z();
  model.grip_height_m *= scale.z();
  model.half_size_m = model.half_size_m.cwiseProduct(scale.head<2>());
  if (model.seat) model.seat->centre_m = model.seat->centre_m.cwiseProduct(scale);
  return model;
}

/// Objects in an order in which each stands on one before it.
Expected<std::vector<const ObjectDescription*>> by_support(
    const std::vector<ObjectDescription>& objects) {
  std::map<std::string, const ObjectDescription*> placed;
  std::vector<const ObjectDescription*> order;
  std::vector<const ObjectDescription*> waiting;
  for (const ObjectDescription& object : objects) waiting.push_back(&object);
  while (!waiting.empty()) {
    std::vector<const ObjectDescription*> next;
    for (const ObjectDescription* object : waiting) {
      if (!object->on.empty() && !placed.contains(object->on)) {
        next.push_back(object);
        continue;
      }
      if (!placed.emplace(object->name, object).second) {
        return make_error(ExitCode::kBadData,
                          "there are two objects called '" + object->name + "'; rename one");
      }
      order.push_back(object);
    }
    if (next.size() == waiting.size()) {
      return make_error(ExitCode::kBadData,
                        "object '" + next.front()->name + "' stands on '" + next.front()->on +
                            "', which stands nowhere; name an object that stands on the floor");
    }
    waiting = std::move(next);
  }
  return order;
}

}  // namespace

SE3 pose_at(const FloorPose& pose, double z_m) {
  return {Eigen::Quaterniond(Eigen::AngleAxisd(pose.yaw_rad, Eigen::Vector3d::UnitZ())),
          {pose.position_m.x(), pose.position_m.y(), z_m}};
}

Expected<std::vector<PlacedObject>> place_objects(const SceneDescription& scene) {
  const std::vector<std::string> types = furniture_types();
  const auto order = by_support(scene.objects);
  if (!order) return tl::unexpected(order.error());
  std::vector<PlacedObject> placed;
  std::map<std::string, std::size_t> index_of;
  for (const ObjectDescription* object : *order) {
    if (std::ranges::find(types, object->type) == types.end()) {
      return make_error(ExitCode::kBadData, "object '" + object->name +
                                                "' is of the unknown type '" + object->type + "'");
    }
    PlacedObject result{.description = *object,
                        .model = model_of(scene, *object),
                        .T_support_object = pose_at(object->pose, object->height_m),
                        .T_world_object = {}};
    result.T_world_object = result.T_support_object;
    if (!object->on.empty()) {
      const PlacedObject& support = placed[index_of.at(object->on)];
      result.T_support_object = pose_at(object->pose, support.model.top_m + object->height_m);
      result.T_world_object = support.T_world_object * result.T_support_object;
    }
    index_of[object->name] = placed.size();
    placed.push_back(std::move(result));
  }
  return placed;
}

}  // namespace tsg::simulation
