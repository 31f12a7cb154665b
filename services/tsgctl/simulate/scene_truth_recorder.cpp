#include "services/tsgctl/simulate/scene_truth_recorder.hpp"

#include <vector>

#include "services/tsgctl/scene_truth/body_volume.hpp"

namespace tsg {
namespace {

using simulation::ObjectBox;
using simulation::SimulatedInstance;

Surface surface_of(const std::vector<Eigen::Vector3f>& points, const render::Mesh& mesh) {
  Surface surface{.points = points, .triangles = {}};
  surface.triangles.reserve(mesh.triangles.size());
  for (const render::Triangle& triangle : mesh.triangles) {
    surface.triangles.push_back(triangle.corners);
  }
  return surface;
}

TrueBox to_true_box(const ObjectBox& box, std::int64_t from_ns) {
  return {.from_ns = from_ns,
          .centre_m = box.centre_m.cast<float>(),
          .size_m = box.size_m.cast<float>(),
          .yaw_rad = static_cast<float>(box.yaw_rad)};
}

bool is_at_same_place(const TrueBox& a, const TrueBox& b) {
  constexpr float kStillM = 1e-4F;  // what the file tells apart
  return (a.centre_m - b.centre_m).norm() < kStillM && std::abs(a.yaw_rad - b.yaw_rad) < kStillM;
}

}  // namespace

SceneTruthRecorder::SceneTruthRecorder(const simulation::World& world) : world_(world) {
  for (const render::Part& part : world.fixed()) {
    add_surface(surface_of(part.mesh.points, part.mesh), truth_.surfaces);
  }
  for (const SimulatedInstance& instance : world.instances()) {
    if (!world.is_person(instance.id)) {
      truth_.objects.push_back({instance.id, instance.class_name, instance.name, {}});
    }
  }
}

void SceneTruthRecorder::add_frame(std::int64_t stamp_ns, double time_s) {
  add_boxes(stamp_ns, time_s);
  std::vector<Eigen::Vector3f> points;
  std::vector<Eigen::Vector3f> unused;
  for (std::size_t body = 0; body < world_.bodies().size(); ++body) {
    const render::Part& part = world_.bodies()[body];
    world_.pose_body(body, time_s, points, unused);
    const Surface surface = surface_of(points, part.mesh);
    if (world_.is_person(part.tag)) {
      add_body(surface, truth_.swept_by_people);
    } else {
      add_surface(surface, truth_.surfaces);
    }
  }
}

void SceneTruthRecorder::add_boxes(std::int64_t stamp_ns, double time_s) {
  const std::vector<ObjectBox> boxes = world_.object_boxes(time_s);
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    std::vector<TrueBox>& known = truth_.objects[i].boxes;
    const TrueBox box = to_true_box(boxes[i], stamp_ns);
    if (known.empty() || !is_at_same_place(known.back(), box)) known.push_back(box);
  }
}

}  // namespace tsg
