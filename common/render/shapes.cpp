#include "common/render/shapes.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tsg::render {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;

/// A flat four-cornered face, corners counter-clockwise from the lower left; uv from `uv_min` at
/// the first corner to `uv_max` at the third.
void add_quad(Mesh& mesh,
              const std::array<Eigen::Vector3f, 4>& corners,
              const Eigen::Vector2f& uv_min,
              const Eigen::Vector2f& uv_max) {
  const auto first = static_cast<std::uint32_t>(mesh.points.size());
  const Eigen::Vector3f normal =
      (corners[1] - corners[0]).cross(corners[3] - corners[0]).normalized();
  mesh.points.insert(mesh.points.end(), corners.begin(), corners.end());
  mesh.normals.insert(mesh.normals.end(), 4, normal);
  mesh.uvs.insert(mesh.uvs.end(), {{uv_min.x(), uv_min.y()},
                                   {uv_max.x(), uv_min.y()},
                                   {uv_max.x(), uv_max.y()},
                                   {uv_min.x(), uv_max.y()}});
  mesh.triangles.push_back({{first, first + 1, first + 2}, 0});
  mesh.triangles.push_back({{first, first + 2, first + 3}, 0});
}

Mesh mesh_of(const Material& material) {
  Mesh mesh;
  mesh.materials.push_back(material);
  return mesh;
}

/// Joins two rows of `columns + 1` points; the row that begins at `upper` lies further along.
void join_rows(Mesh& mesh, std::uint32_t lower, std::uint32_t upper, std::uint32_t columns) {
  for (std::uint32_t i = 0; i < columns; ++i) {
    mesh.triangles.push_back({{lower + i, lower + i + 1, upper + i + 1}, 0});
    mesh.triangles.push_back({{lower + i, upper + i + 1, upper + i}, 0});
  }
}

/// Smooth normals where faces share points: means of the faces, weighted by area.
void set_smooth_normals(Mesh& mesh) {
  mesh.normals.assign(mesh.points.size(), Eigen::Vector3f::Zero());
  for (const Triangle& triangle : mesh.triangles) {
    const auto& [a, b, c] = triangle.corners;
    const Eigen::Vector3f weighted =
        (mesh.points[b] - mesh.points[a]).cross(mesh.points[c] - mesh.points[a]);
    for (const std::uint32_t corner : triangle.corners) mesh.normals[corner] += weighted;
  }
  for (Eigen::Vector3f& normal : mesh.normals) {
    const float length = normal.norm();
    normal = length > 0.0F ? Eigen::Vector3f(normal / length) : Eigen::Vector3f::UnitZ();
  }
}

/// First and last points of rows lie on each other, but have uvs of their own: one normal for both.
void join_seam(Mesh& mesh, std::uint32_t rows, std::uint32_t columns) {
  for (std::uint32_t row = 0; row < rows; ++row) {
    const std::uint32_t begin = row * (columns + 1);
    Eigen::Vector3f& first = mesh.normals[begin];
    Eigen::Vector3f& last = mesh.normals[begin + columns];
    // Where the row shrinks to a point, the last one has no face and hence no normal of its own.
    const bool is_pole = (mesh.points[begin] - mesh.points[begin + 1]).isZero(1e-9F);
    first = last = is_pole ? first : Eigen::Vector3f((first + last).normalized());
  }
}

/// A face of a box around the origin that is to be rounded.
struct SharpFace {
  int axis = 0;  ///< which it looks along
  float side = 1.0F;
  Eigen::Vector3f half;
  float radius = 0.0F;
  int flat_steps = 1;
};

/// Where a face is cut along one of its sides: densely where it will bend by 45 degrees at either
/// end, `flat_steps` times in between.
std::vector<float> cuts_along(float half, float radius, int flat_steps) {
  constexpr int kBendSteps = 2;
  const float flat = half - radius;
  std::vector<float> cuts;
  for (int i = kBendSteps; i > 0; --i) {
    const double angle = kTurn / 8.0 * i / kBendSteps;
    cuts.push_back(-flat - radius * static_cast<float>(std::tan(angle)));
  }
  for (int i = 0; i <= flat_steps; ++i) {
    cuts.push_back(flat * (2.0F * static_cast<float>(i) / static_cast<float>(flat_steps) - 1.0F));
  }
  for (std::size_t i = 0; i < kBendSteps; ++i) cuts.push_back(-cuts[kBendSteps - 1 - i]);
  return cuts;
}

/// Adds the face as a grid; uv in metres, v down where the face stands upright.
void add_sharp_face(Mesh& mesh, const SharpFace& face) {
  const int along = face.axis == 2 ? 0 : (face.axis + 1) % 2;  // lies level
  const int up = 3 - face.axis - along;
  const std::vector<float> columns = cuts_along(face.half[along], face.radius, face.flat_steps);
  const std::vector<float> rows = cuts_along(face.half[up], face.radius, face.flat_steps);
  const auto first = static_cast<std::uint32_t>(mesh.points.size());
  Eigen::Vector3f right = Eigen::Vector3f::Unit(along);
  // Seen from outside, `right` x `up` looks at the viewer.
  if (right.cross(Eigen::Vector3f::Unit(up))[face.axis] * face.side < 0.0F) right = -right;
  for (const float row : rows) {
    for (const float column : columns) {
      mesh.points.emplace_back(column * right + row * Eigen::Vector3f::Unit(up) +
                               face.side * face.half[face.axis] * Eigen::Vector3f::Unit(face.axis));
      mesh.uvs.emplace_back(column, -row);
    }
  }
  mesh.normals.resize(mesh.points.size());
  const auto width = static_cast<std::uint32_t>(columns.size());
  for (std::uint32_t row = 0; row + 1 < rows.size(); ++row) {
    join_rows(mesh, first + row * width, first + (row + 1) * width, width - 1);
  }
}

/// Closes a tube at the row of points that begins at `first`.
void add_cap(Mesh& mesh,
             const Eigen::Vector3f& middle,
             std::uint32_t first,
             std::uint32_t columns,
             bool is_end) {
  const auto centre = static_cast<std::uint32_t>(mesh.points.size());
  mesh.points.push_back(middle);
  mesh.uvs.emplace_back(mesh.uvs[first]);
  for (std::uint32_t here = first; here < first + columns; ++here) {
    const std::uint32_t a = is_end ? here : here + 1;
    const std::uint32_t b = is_end ? here + 1 : here;
    mesh.triangles.push_back({{a, b, centre}, 0});
  }
}

}  // namespace

Mesh make_box(const Eigen::Vector3f& size_m, const Material& material) {
  Mesh mesh = mesh_of(material);
  const float x = 0.5F * size_m.x();
  const float y = 0.5F * size_m.y();
  const float z = size_m.z();
  const auto add = [&](const std::array<Eigen::Vector3f, 4>& corners, float width, float height) {
    add_quad(mesh, corners, {0.0F, height}, {width, 0.0F});
  };
  add({{{x, -y, 0}, {x, y, 0}, {x, y, z}, {x, -y, z}}}, 2 * y, z);
  add({{{-x, y, 0}, {-x, -y, 0}, {-x, -y, z}, {-x, y, z}}}, 2 * y, z);
  add({{{x, y, 0}, {-x, y, 0}, {-x, y, z}, {x, y, z}}}, 2 * x, z);
  add({{{-x, -y, 0}, {x, -y, 0}, {x, -y, z}, {-x, -y, z}}}, 2 * x, z);
  add({{{-x, -y, z}, {x, -y, z}, {x, y, z}, {-x, y, z}}}, 2 * x, 2 * y);
  add({{{-x, y, 0}, {x, y, 0}, {x, -y, 0}, {-x, -y, 0}}}, 2 * x, 2 * y);
  return mesh;
}

Mesh make_rounded_box(const Eigen::Vector3f& size_m,
                      float radius_m,
                      const Material& material,
                      int flat_steps) {
  const Eigen::Vector3f half = 0.5F * size_m;
  const float radius = std::min(radius_m, half.minCoeff());
  const Eigen::Vector3f inner = half - Eigen::Vector3f::Constant(radius);
  Mesh mesh = mesh_of(material);
  for (int axis = 0; axis < 3; ++axis) {
    for (const float side : {-1.0F, 1.0F})
      add_sharp_face(mesh, {axis, side, half, radius, flat_steps});
  }
  const Eigen::Vector3f middle(0.0F, 0.0F, half.z());
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    const Eigen::Vector3f core = mesh.points[i].cwiseMax(-inner).cwiseMin(inner);
    const Eigen::Vector3f normal = (mesh.points[i] - core).normalized();
    mesh.points[i] = core + radius * normal + middle;
    mesh.normals[i] = normal;
  }
  return mesh;
}

Mesh make_picture(float width_m, float height_m, const Material& material) {
  Mesh mesh = mesh_of(material);
  const float y = 0.5F * width_m;
  add_quad(mesh, {{{0, -y, 0}, {0, y, 0}, {0, y, height_m}, {0, -y, height_m}}}, {0, 1}, {1, 0});
  return mesh;
}

Mesh make_disc(float radius_m, int sides, const Material& material) {
  Mesh mesh = mesh_of(material);
  mesh.points.emplace_back(Eigen::Vector3f::Zero());
  for (int i = 0; i < sides; ++i) {
    const double angle = kTurn * i / sides;
    mesh.points.emplace_back(radius_m * static_cast<float>(std::cos(angle)),
                             radius_m * static_cast<float>(std::sin(angle)), 0.0F);
  }
  mesh.normals.assign(mesh.points.size(), Eigen::Vector3f::UnitZ());
  for (const Eigen::Vector3f& point : mesh.points) mesh.uvs.emplace_back(point.x(), -point.y());
  const auto corners = static_cast<std::uint32_t>(sides);
  for (std::uint32_t i = 0; i < corners; ++i) {
    mesh.triangles.push_back({{0, i + 1, (i + 1) % corners + 1}, 0});
  }
  return mesh;
}

Mesh make_turned(const std::vector<OutlinePoint>& outline, int sides, const Material& material) {
  Mesh mesh = mesh_of(material);
  const auto columns = static_cast<std::uint32_t>(sides);
  float along_m = 0.0F;
  for (std::size_t row = 0; row < outline.size(); ++row) {
    const OutlinePoint& point = outline[row];
    if (row > 0) {
      along_m +=
          std::hypot(point.radius_m - outline[row - 1].radius_m, point.z_m - outline[row - 1].z_m);
    }
    for (std::uint32_t i = 0; i <= columns; ++i) {
      const double angle = kTurn * i / columns;
      mesh.points.emplace_back(point.radius_m * static_cast<float>(std::cos(angle)),
                               point.radius_m * static_cast<float>(std::sin(angle)), point.z_m);
      mesh.uvs.emplace_back(static_cast<float>(i) / static_cast<float>(columns), -along_m);
    }
  }
  const auto rows = static_cast<std::uint32_t>(outline.size());
  for (std::uint32_t row = 0; row + 1 < rows; ++row) {
    join_rows(mesh, row * (columns + 1), (row + 1) * (columns + 1), columns);
  }
  set_smooth_normals(mesh);
  join_seam(mesh, rows, columns);
  return mesh;
}

Mesh make_tube(const std::vector<TubeRing>& rings, int sides, const Material& material) {
  Mesh mesh = mesh_of(material);
  const auto columns = static_cast<std::uint32_t>(sides);
  float along_m = 0.0F;
  for (std::size_t row = 0; row < rings.size(); ++row) {
    const TubeRing& ring = rings[row];
    if (row > 0) along_m += (ring.centre - rings[row - 1].centre).norm();
    for (std::uint32_t i = 0; i <= columns; ++i) {
      const double angle = kTurn * i / columns;
      mesh.points.emplace_back(ring.centre +
                               static_cast<float>(std::cos(angle)) * ring.half_axis_a +
                               static_cast<float>(std::sin(angle)) * ring.half_axis_b);
      mesh.uvs.emplace_back(static_cast<float>(i) / static_cast<float>(columns), -along_m);
    }
  }
  const auto rows = static_cast<std::uint32_t>(rings.size());
  for (std::uint32_t row = 0; row + 1 < rows; ++row) {
    join_rows(mesh, row * (columns + 1), (row + 1) * (columns + 1), columns);
  }
  add_cap(mesh, rings.front().centre, 0, columns, false);
  add_cap(mesh, rings.back().centre, (rows - 1) * (columns + 1), columns, true);
  set_smooth_normals(mesh);
  join_seam(mesh, rows, columns);
  return mesh;
}

Mesh make_bar(const Eigen::Vector3f& from,
              const Eigen::Vector3f& to,
              float radius_m,
              const Material& material) {
  const Eigen::Vector3f along = (to - from).normalized();
  const Eigen::Vector3f a = along.unitOrthogonal() * radius_m;
  const Eigen::Vector3f b = along.cross(a);
  return make_tube({{from, a, b}, {to, a, b}}, 10, material);
}

}  // namespace tsg::render
