#include <algorithm>
#include <array>
#include <cmath>

#include "common/simulation/furniture/materials.hpp"
#include "common/simulation/furniture/openings.hpp"

namespace tsg::simulation {
namespace {

using Eigen::Vector3f;

constexpr float kFrame = 0.055F;
constexpr float kOutwards = static_cast<float>(kWallThickness);

render::Material window_paint() { return materials::plain({222, 228, 230}, 0.3F); }

Vector3f middle_of(const Hole& hole) {
  return {0.0F, 0.5F * (hole.left_m + hole.right_m), 0.5F * (hole.bottom_m + hole.top_m)};
}

/// Boards over the cut through the wall, `depth_m` deep, and the sill, which stands into the room.
void add_reveal(Assembly& parts, const Hole& hole, float depth_m) {
  const render::Material paint = window_paint();
  constexpr float kBoard = 0.012F;
  const float x = -0.5F * depth_m;
  const float width = hole.right_m - hole.left_m;
  const Vector3f middle = middle_of(hole);
  for (const float y : {hole.left_m + 0.5F * kBoard, hole.right_m - 0.5F * kBoard}) {
    parts.box({depth_m + 0.003F, kBoard, hole.top_m - hole.bottom_m}, {x, y, hole.bottom_m}, paint);
  }
  parts.box({depth_m + 0.003F, width - 2.0F * kBoard, kBoard}, {x, middle.y(), hole.top_m - kBoard},
            paint);
  parts.box({depth_m + 0.16F, width + 0.06F, 0.03F},
            {x + 0.08F, middle.y(), hole.bottom_m - 0.012F},
            materials::plain({205, 210, 212}, 0.5F));
}

/// Casements with their bars, as many as the width asks for, and a handle on each.
void add_frame(Assembly& parts, const Hole& hole, float x) {
  const render::Material paint = window_paint();
  const float width = hole.right_m - hole.left_m;
  const float height = hole.top_m - hole.bottom_m;
  const int casements = std::max(1, static_cast<int>(std::lround(width / 0.8F)));
  const float pitch = width / static_cast<float>(casements);
  for (int i = 0; i < casements; ++i) {
    const float left = hole.left_m + pitch * static_cast<float>(i);
    for (const float y : {left + 0.5F * kFrame, left + pitch - 0.5F * kFrame}) {
      parts.box({0.05F, kFrame, height - 0.03F}, {x, y, hole.bottom_m + 0.018F}, paint);
    }
    const float bar = pitch - 2.0F * kFrame;
    for (const float z : {hole.bottom_m + 0.018F, hole.top_m - kFrame - 0.012F}) {
      parts.box({0.05F, bar, kFrame}, {x, left + 0.5F * pitch, z}, paint);
    }
    const float y = left + pitch - 0.5F * kFrame;
    const float z = hole.bottom_m + 0.45F * height;
    parts.pipe({{x + 0.02F, y, z}, {x + 0.06F, y, z}, {x + 0.062F, y, z - 0.11F}}, 0.008F,
               materials::chrome());
  }
}

/// What is seen through the window: a picture bent around its outside, closed above and below, so
/// that no line of sight through the hole passes by.
render::Mesh make_view(const Hole& hole, const cv::Mat& picture) {
  render::Material material = materials::pictured(picture, 1.0, 0.0F);
  material.emission = 1.1F;
  material.returns_depth = false;
  constexpr float kBeside = 0.7F;
  constexpr float kAbove = 0.5F;
  const std::array<Eigen::Vector2f, 6> outline = {Eigen::Vector2f(-kOutwards, hole.right_m),
                                                  {-0.5F, hole.right_m + kBeside},
                                                  {-1.0F, hole.right_m + 0.5F * kBeside},
                                                  {-1.0F, hole.left_m - 0.5F * kBeside},
                                                  {-0.5F, hole.left_m - kBeside},
                                                  {-kOutwards, hole.left_m}};
  const float low = hole.bottom_m - kAbove;
  const float high = hole.top_m + kAbove;
  render::Mesh view;
  view.materials.push_back(material);
  const auto add = [&](const std::array<Vector3f, 4>& corners,
                       const std::array<Eigen::Vector2f, 4>& uvs) {
    const auto first = static_cast<std::uint32_t>(view.points.size());
    const Vector3f normal = (corners[1] - corners[0]).cross(corners[3] - corners[0]).normalized();
    view.points.insert(view.points.end(), corners.begin(), corners.end());
    view.normals.insert(view.normals.end(), 4, normal);
    view.uvs.insert(view.uvs.end(), uvs.begin(), uvs.end());
    view.triangles.push_back({{first, first + 1, first + 2}, 0});
    view.triangles.push_back({{first, first + 2, first + 3}, 0});
  };
  constexpr std::array kShares = {0.02F, 0.16F, 0.26F, 0.74F, 0.84F, 0.98F};  // of the picture
  for (std::size_t i = 0; i + 1 < outline.size(); ++i) {
    const Eigen::Vector2f& a = outline.at(i + 1);
    const Eigen::Vector2f& b = outline.at(i);
    const float u_a = 1.0F - kShares.at(i + 1);
    const float u_b = 1.0F - kShares.at(i);
    add({{{a.x(), a.y(), low}, {b.x(), b.y(), low}, {b.x(), b.y(), high}, {a.x(), a.y(), high}}},
        {{{u_a, 0.97F}, {u_b, 0.97F}, {u_b, 0.03F}, {u_a, 0.03F}}});
  }
  const float left = hole.left_m - kBeside;
  const float right = hole.right_m + kBeside;
  constexpr float kFar = -1.0F;
  add({{{kFar, left, low}, {-kOutwards, left, low}, {-kOutwards, right, low}, {kFar, right, low}}},
      {{{0.1F, 0.97F}, {0.1F, 0.99F}, {0.9F, 0.99F}, {0.9F, 0.97F}}});
  add({{{kFar, left, high},
        {kFar, right, high},
        {-kOutwards, right, high},
        {-kOutwards, left, high}}},
      {{{0.1F, 0.03F}, {0.9F, 0.03F}, {0.9F, 0.02F}, {0.1F, 0.02F}}});
  return view;
}

/// Daylight through the hole: soft and a little blue.
Lamp daylight(const Wall& wall, const Hole& hole) {
  const Eigen::Matrix3f R_world_wall = wall.T_world_wall.rotation_matrix().cast<float>();
  const Vector3f centre = middle_of(hole) + Vector3f(0.01F, 0.0F, 0.0F);
  Lamp lamp;
  lamp.centre_m = (wall.T_world_wall * centre.cast<double>()).cast<float>();
  lamp.half_side_a_m = R_world_wall * Vector3f(0.0F, 0.5F * (hole.right_m - hole.left_m), 0.0F);
  lamp.half_side_b_m = R_world_wall * Vector3f(0.0F, 0.0F, 0.5F * (hole.top_m - hole.bottom_m));
  lamp.normal = R_world_wall.col(0);
  lamp.radiance_bgr = {1.3F, 1.2F, 1.12F};
  return lamp;
}

/// One window in the wall's axes; `depth` as depth_through() tells it.
render::Mesh make_window(const Hole& hole, const std::optional<float>& depth, std::uint64_t seed) {
  Assembly window;
  add_reveal(window, hole, depth ? 0.5F * *depth : kOutwards);
  add_frame(window, hole, depth ? -0.5F * *depth + 0.025F : -kOutwards + 0.035F);
  if (!depth) {
    Random random(seed_of(seed, "window " + std::to_string(hole.opening)));
    window.add(make_view(hole, textures::outside(random)));
  }
  return window.finished();
}

}  // namespace

void add_windows(Building& building,
                 Assembly& parts,
                 const std::vector<Wall>& walls,
                 std::uint64_t seed) {
  for (const Wall& wall : walls) {
    for (const Hole& hole : wall.holes) {
      if (hole.is_door) continue;
      const std::optional<float> depth = depth_through(wall, hole, walls);
      parts.add(make_window(hole, depth, seed), wall.T_world_wall);
      if (!depth) building.lamps.push_back(daylight(wall, hole));
    }
  }
}

}  // namespace tsg::simulation
