#include "services/tsgctl/map/map_mesh.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <vector>

namespace tsg {
namespace {

using octomap::ColorOcTree;
using octomap::ColorOcTreeNode;
using render::Material;
using render::Mesh;

constexpr double kStrayLeaves = 0.005;  ///< of all leaves, on each side of the extent
constexpr int kColourStep = 8;          ///< colours closer than this count as one: fewer materials

/// A side of a leaf: a square.
struct Side {
  Eigen::Vector3d centre_m;
  Eigen::Vector3d normal;
  double edge_m = 0.0;
};

Eigen::Vector3d to_eigen(const octomap::point3d& point) {
  return {point.x(), point.y(), point.z()};
}

bool is_free(const ColorOcTree& tree, const Eigen::Vector3d& position_m) {
  const ColorOcTreeNode* node = tree.search(position_m.x(), position_m.y(), position_m.z());
  return node != nullptr && !tree.isNodeOccupied(node);
}

/// Calls `use(side, colour)` for each side that an eye may see.
template <typename Use>
void for_each_side(const ColorOcTree& tree, const Eigen::Vector3d& eye_m, const Use& use) {
  const double resolution_m = tree.getResolution();
  for (auto leaf = tree.begin_leafs(); leaf != tree.end_leafs(); ++leaf) {
    if (!tree.isNodeOccupied(*leaf)) continue;
    const Eigen::Vector3d centre_m = to_eigen(leaf.getCoordinate());
    for (int axis = 0; axis < 3; ++axis) {
      const double towards = eye_m[axis] - centre_m[axis];
      if (std::abs(towards) < 0.5 * leaf.getSize()) continue;
      const Eigen::Vector3d normal = Eigen::Vector3d::Unit(axis) * (towards > 0.0 ? 1.0 : -1.0);
      const Side side{centre_m + 0.5 * leaf.getSize() * normal, normal, leaf.getSize()};
      if (is_free(tree, side.centre_m + 0.5 * resolution_m * normal)) use(side, leaf->getColor());
    }
  }
}

float linear_light(int code) {
  const double value = code / 255.0;
  return static_cast<float>(value <= 0.04045 ? value / 12.92
                                             : std::pow((value + 0.055) / 1.055, 2.4));
}

/// The index of a leaf's colour among the materials of a mesh.
class Palette {
 public:
  explicit Palette(Mesh& mesh) : mesh_(mesh) {}

  std::uint32_t index_of(const ColorOcTreeNode::Color& colour) {
    const std::array<int, 3> key{colour.b / kColourStep, colour.g / kColourStep,
                                 colour.r / kColourStep};
    const auto [found, is_new] =
        indices_.emplace(key, static_cast<std::uint32_t>(mesh_.materials.size()));
    if (is_new) {
      Material material;
      material.colour_bgr = {linear_light(colour.b), linear_light(colour.g),
                             linear_light(colour.r)};
      mesh_.materials.push_back(material);
    }
    return found->second;
  }

 private:
  Mesh& mesh_;
  std::map<std::array<int, 3>, std::uint32_t> indices_;
};

void add_square(Mesh& mesh, const Side& side, std::uint32_t material) {
  const Eigen::Vector3f normal = side.normal.cast<float>();
  const Eigen::Vector3f centre = side.centre_m.cast<float>();
  const auto half = static_cast<float>(0.5 * side.edge_m);
  const Eigen::Vector3f a = half * Eigen::Vector3f(normal.y(), normal.z(), normal.x()).cwiseAbs();
  const Eigen::Vector3f b = normal.cross(a);
  const auto first = static_cast<std::uint32_t>(mesh.points.size());
  constexpr std::array<std::array<float, 2>, 4> kCorners{
      {{-1.0F, -1.0F}, {1.0F, -1.0F}, {1.0F, 1.0F}, {-1.0F, 1.0F}}};
  for (const auto& [along_a, along_b] : kCorners) {
    mesh.points.emplace_back(centre + along_a * a + along_b * b);
    mesh.normals.push_back(normal);
    mesh.uvs.emplace_back(0.0F, 0.0F);
  }
  mesh.triangles.push_back({{first, first + 1, first + 2}, material});
  mesh.triangles.push_back({{first, first + 2, first + 3}, material});
}

}  // namespace

Mesh make_map_mesh(const ColorOcTree& tree, const Eigen::Vector3d& eye_m) {
  Mesh mesh;
  Palette palette(mesh);
  for_each_side(tree, eye_m, [&](const Side& side, const ColorOcTreeNode::Color& colour) {
    add_square(mesh, side, palette.index_of(colour));
  });
  return mesh;
}

double visible_area_m2(const ColorOcTree& tree, const Eigen::Vector3d& eye_m) {
  double area_m2 = 0.0;
  for_each_side(tree, eye_m, [&](const Side& side, const ColorOcTreeNode::Color& /*colour*/) {
    area_m2 += side.edge_m * side.edge_m * side.normal.dot((eye_m - side.centre_m).normalized());
  });
  return area_m2;
}

MapExtent extent_of(const ColorOcTree& tree) {
  std::array<std::vector<double>, 3> coordinates;
  for (auto leaf = tree.begin_leafs(); leaf != tree.end_leafs(); ++leaf) {
    if (!tree.isNodeOccupied(*leaf)) continue;
    const Eigen::Vector3d centre_m = to_eigen(leaf.getCoordinate());
    for (int axis = 0; axis < 3; ++axis) {
      coordinates.at(static_cast<std::size_t>(axis)).push_back(centre_m[axis]);
    }
  }
  const double half_leaf_m = 0.5 * tree.getResolution();
  MapExtent extent;
  for (int axis = 0; axis < 3; ++axis) {
    auto& values = coordinates.at(static_cast<std::size_t>(axis));
    std::ranges::sort(values);
    const auto stray = static_cast<std::size_t>(kStrayLeaves * static_cast<double>(values.size()));
    extent.low_m[axis] = values[stray] - half_leaf_m;
    extent.high_m[axis] = values[values.size() - 1 - stray] + half_leaf_m;
  }
  return extent;
}

}  // namespace tsg
