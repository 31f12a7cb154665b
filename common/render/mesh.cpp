#include "common/render/mesh.hpp"

#include <algorithm>
#include <map>
#include <utility>

namespace tsg::render {
namespace {

using Edge = std::pair<std::uint32_t, std::uint32_t>;

/// Splits long edges of a mesh in the middle, once; both triangles of an edge get the same point.
class EdgeSplitter {
 public:
  EdgeSplitter(Mesh& mesh, float max_edge_m) : mesh_(mesh), max_edge_m_(max_edge_m) {}

  /// Whether any edge was too long.
  bool split_all() {
    std::vector<Triangle> result;
    result.reserve(mesh_.triangles.size());
    for (const Triangle& triangle : mesh_.triangles) split(triangle, result);
    const bool any = result.size() != mesh_.triangles.size();
    mesh_.triangles = std::move(result);
    return any;
  }

 private:
  [[nodiscard]] float length(std::uint32_t a, std::uint32_t b) const {
    return (mesh_.points[a] - mesh_.points[b]).norm();
  }

  /// Splits the longest edge only: the halves are split in the next round where needed.
  void split(const Triangle& triangle, std::vector<Triangle>& result) {
    const auto& corners = triangle.corners;
    std::size_t longest = 0;
    for (std::size_t i = 1; i < 3; ++i) {
      if (edge_length(corners, i) > edge_length(corners, longest)) longest = i;
    }
    if (!(edge_length(corners, longest) > max_edge_m_)) {  // so that NaN ends here, too
      result.push_back(triangle);
      return;
    }
    const std::uint32_t from = corners.at(longest);
    const std::uint32_t to = corners.at((longest + 1) % 3);
    const std::uint32_t opposite = corners.at((longest + 2) % 3);
    const std::uint32_t middle = middle_of(from, to);
    result.push_back({{from, middle, opposite}, triangle.material});
    result.push_back({{middle, to, opposite}, triangle.material});
  }

  [[nodiscard]] float edge_length(const std::array<std::uint32_t, 3>& corners,
                                  std::size_t edge) const {
    return length(corners.at(edge), corners.at((edge + 1) % 3));
  }

  std::uint32_t middle_of(std::uint32_t a, std::uint32_t b) {
    const auto [entry, is_new] = middles_.try_emplace(
        Edge(std::min(a, b), std::max(a, b)), static_cast<std::uint32_t>(mesh_.points.size()));
    if (is_new) {
      mesh_.points.emplace_back(0.5F * (mesh_.points[a] + mesh_.points[b]));
      mesh_.normals.emplace_back((mesh_.normals[a] + mesh_.normals[b]).normalized());
      mesh_.uvs.emplace_back(0.5F * (mesh_.uvs[a] + mesh_.uvs[b]));
    }
    return entry->second;
  }

  Mesh& mesh_;
  float max_edge_m_;
  std::map<Edge, std::uint32_t> middles_;
};

}  // namespace

void Mesh::append(const Mesh& other, const SE3& T_this_other) {
  const auto first_point = static_cast<std::uint32_t>(points.size());
  const auto first_material = static_cast<std::uint32_t>(materials.size());
  const Eigen::Matrix3f R_this_other = T_this_other.rotation_matrix().cast<float>();
  const Eigen::Vector3f t_this_other = T_this_other.translation().cast<float>();
  for (const Eigen::Vector3f& point : other.points) {
    points.emplace_back(R_this_other * point + t_this_other);
  }
  for (const Eigen::Vector3f& normal : other.normals) normals.emplace_back(R_this_other * normal);
  uvs.insert(uvs.end(), other.uvs.begin(), other.uvs.end());
  materials.insert(materials.end(), other.materials.begin(), other.materials.end());
  for (Triangle triangle : other.triangles) {
    for (std::uint32_t& corner : triangle.corners) corner += first_point;
    triangle.material += first_material;
    triangles.push_back(triangle);
  }
}

Mesh subdivided(const Mesh& mesh, float max_edge_m) {
  Mesh result = mesh;
  EdgeSplitter splitter(result, max_edge_m);
  while (splitter.split_all()) {
  }
  return result;
}

}  // namespace tsg::render
