#include "common/simulation/furniture/assembly.hpp"

#include <algorithm>
#include <cstdint>

namespace tsg::simulation {
namespace {

bool is_same(const render::Material& a, const render::Material& b) {
  return a.colour_bgr == b.colour_bgr && a.texture == b.texture &&
         a.texture_repeats == b.texture_repeats && a.emission == b.emission && a.gloss == b.gloss &&
         a.returns_depth == b.returns_depth;
}

Eigen::Quaterniond turn(double angle_rad, const Eigen::Vector3d& axis) {
  return Eigen::Quaterniond(Eigen::AngleAxisd(angle_rad, axis));
}

}  // namespace

SE3 placed(const Eigen::Vector3f& at, double yaw_rad) {
  return {turn(yaw_rad, Eigen::Vector3d::UnitZ()), at.cast<double>()};
}

SE3 tilted(const Eigen::Vector3f& at, double pitch_rad, double yaw_rad) {
  return {turn(yaw_rad, Eigen::Vector3d::UnitZ()) * turn(pitch_rad, Eigen::Vector3d::UnitY()),
          at.cast<double>()};
}

void Assembly::add(const render::Mesh& part, const SE3& T_model_part) {
  mesh_.append(part, T_model_part);
}

void Assembly::box(const Eigen::Vector3f& size_m,
                   const Eigen::Vector3f& at,
                   const render::Material& material,
                   double yaw_rad) {
  add(render::make_box(size_m, material), placed(at, yaw_rad));
}

void Assembly::cushion(const Eigen::Vector3f& size_m,
                       const SE3& T_model_part,
                       float radius_m,
                       const render::Material& material) {
  add(render::make_rounded_box(size_m, radius_m, material), T_model_part);
}

void Assembly::bar(const Eigen::Vector3f& from,
                   const Eigen::Vector3f& to,
                   float radius_m,
                   const render::Material& material) {
  add(render::make_bar(from, to, radius_m, material));
}

void Assembly::pipe(const std::vector<Eigen::Vector3f>& points,
                    float radius_m,
                    const render::Material& material) {
  const auto count = points.size();
  std::vector<render::TubeRing> rings;
  Eigen::Vector3f a = Eigen::Vector3f::Zero();
  for (std::size_t i = 0; i < count; ++i) {
    const Eigen::Vector3f along =
        (points[std::min(i + 1, count - 1)] - points[i == 0 ? 0 : i - 1]).normalized();
    // The half axis follows the one before, so that the tube does not twist.
    a = i == 0 ? along.unitOrthogonal() : Eigen::Vector3f((a - a.dot(along) * along).normalized());
    rings.push_back({points[i], radius_m * a, radius_m * along.cross(a)});
  }
  add(render::make_tube(rings, 8, material));
}

void Assembly::turned(const std::vector<std::vector<render::OutlinePoint>>& outlines,
                      const Eigen::Vector3f& at,
                      const render::Material& material,
                      int sides) {
  for (const auto& outline : outlines) {
    add(render::make_turned(outline, sides, material), placed(at));
  }
}

render::Mesh Assembly::finished() const {
  render::Mesh result = mesh_;
  result.materials.clear();
  std::vector<std::uint32_t> kept;
  for (const render::Material& material : mesh_.materials) {
    const auto known = std::find_if(
        result.materials.begin(), result.materials.end(),
        [&](const render::Material& candidate) { return is_same(candidate, material); });
    kept.push_back(static_cast<std::uint32_t>(known - result.materials.begin()));
    if (known == result.materials.end()) result.materials.push_back(material);
  }
  for (render::Triangle& triangle : result.triangles) triangle.material = kept[triangle.material];
  return result;
}

void use_cell(render::Mesh& part, int index, int columns, int rows) {
  const Eigen::Vector2f size(1.0F / static_cast<float>(columns), 1.0F / static_cast<float>(rows));
  const Eigen::Vector2f corner(static_cast<float>(index % columns) * size.x(),
                               static_cast<float>(index / columns % rows) * size.y());
  for (Eigen::Vector2f& uv : part.uvs) uv = corner + uv.cwiseProduct(size);
}

}  // namespace tsg::simulation
