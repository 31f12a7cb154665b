#include "services/tsgctl/map/map_picture.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <memory>
#include <numbers>
#include <opencv2/imgcodecs.hpp>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "common/core/atomic_file.hpp"
#include "common/render/preview.hpp"
#include "common/render/renderer.hpp"
#include "services/tsgctl/map/map_mesh.hpp"

namespace tsg {
namespace {

namespace fs = std::filesystem;
using octomap::ColorOcTree;

constexpr int kWidth = 1200;
constexpr int kHeight = 900;
constexpr double kElevation = 38.0;     // degrees, of the eye
constexpr double kDistance = 1.5;       // of the eye, in sizes of the map
constexpr double kFill = 0.9;           // of the picture
constexpr double kStrayPoints = 0.002;  // of the points, that may fall out of it at each edge
constexpr int kDirections = 12;         // round the map, tried for the best view
constexpr float kBackground = 0.93F;    // light grey

/// An eye in that direction, far enough for walls to look nearly parallel.
Eigen::Vector3d eye_towards(const MapExtent& extent, double azimuth_rad) {
  const double elevation_rad = kElevation * std::numbers::pi / 180.0;
  const Eigen::Vector3d direction(std::cos(elevation_rad) * std::cos(azimuth_rad),
                                  std::cos(elevation_rad) * std::sin(azimuth_rad),
                                  std::sin(elevation_rad));
  const double size_m = (extent.high_m - extent.low_m).norm();
  return extent.centre_m() + kDistance * size_m * direction;
}

Eigen::Vector3d best_eye(const ColorOcTree& tree, const MapExtent& extent) {
  Eigen::Vector3d best = Eigen::Vector3d::Zero();
  double best_area_m2 = -1.0;
  for (int i = 0; i < kDirections; ++i) {
    // Half a step off the axes: walls, which mostly lie along them, show their faces obliquely.
    const double azimuth_rad = 2.0 * std::numbers::pi * (i + 0.5) / kDirections;
    const Eigen::Vector3d eye_m = eye_towards(extent, azimuth_rad);
    const double area_m2 = visible_area_m2(tree, eye_m);
    if (area_m2 <= best_area_m2) continue;
    best = eye_m;
    best_area_m2 = area_m2;
  }
  return best;
}

/// The middle of all values but the few most extreme, and their range.
struct Spread {
  double middle = 0.0;
  double range = 0.0;
};

Spread spread_of(std::vector<double> values) {
  std::ranges::sort(values);
  const auto stray = static_cast<std::size_t>(kStrayPoints * static_cast<double>(values.size()));
  const double low = values[stray];
  const double high = values[values.size() - 1 - stray];
  return {0.5 * (low + high), std::max(high - low, 1e-6)};
}

/// The camera there whose picture the mesh just fills.
CameraModel framing_camera(const render::Mesh& mesh, const SE3& T_map_camera) {
  std::vector<double> xs;
  std::vector<double> ys;
  const SE3 T_camera_map = T_map_camera.inverse();
  for (const Eigen::Vector3f& point : mesh.points) {
    const Eigen::Vector3d p_camera = T_camera_map * Eigen::Vector3d(point.cast<double>());
    xs.push_back(p_camera.x() / p_camera.z());
    ys.push_back(p_camera.y() / p_camera.z());
  }
  const Spread x = spread_of(std::move(xs));
  const Spread y = spread_of(std::move(ys));
  const double focal_px = kFill * std::min(kWidth / x.range, kHeight / y.range);
  return {.width = kWidth,
          .height = kHeight,
          .fx = focal_px,
          .fy = focal_px,
          .cx = 0.5 * (kWidth - 1) - focal_px * x.middle,
          .cy = 0.5 * (kHeight - 1) - focal_px * y.middle};
}

/// One big lamp above, one behind the camera and one at its side, so that the three directions of
/// faces differ in brightness.
std::vector<render::Lamp> lamps_for(const MapExtent& extent, const Eigen::Vector3d& eye_m) {
  const Eigen::Vector3d centre_m = extent.centre_m();
  const double reach_m = (extent.high_m - extent.low_m).norm();
  const Eigen::Vector3d to_eye = (eye_m - centre_m).normalized();
  const Eigen::Vector3d aside = Eigen::Vector3d::UnitZ().cross(to_eye).normalized();
  std::vector<render::Lamp> lamps;
  const auto add = [&](const Eigen::Vector3d& direction, float radiance) {
    const Eigen::Vector3f normal = -direction.normalized().cast<float>();
    const Eigen::Vector3f a = normal.unitOrthogonal();
    const Eigen::Vector3f position =
        (centre_m + 2.0 * reach_m * direction.normalized()).cast<float>();
    const auto half = static_cast<float>(0.7 * reach_m);
    lamps.push_back(
        {position, half * a, half * normal.cross(a), normal, Eigen::Vector3f::Constant(radiance)});
  };
  add(Eigen::Vector3d::UnitZ(), 8.0F);
  add(to_eye + 0.6 * aside, 4.5F);
  add(to_eye - 0.9 * aside, 2.0F);
  return lamps;
}

bool has_occupied_leaf(const ColorOcTree& tree) {
  return std::any_of(tree.begin_leafs(), tree.end_leafs(),
                     [&](const auto& leaf) { return tree.isNodeOccupied(leaf); });
}

/// The header of OctoMap's file format, up to its line "data".
struct TreeHeader {
  std::string id;
  std::size_t nodes = 0;
  double resolution_m = 0.0;
};

std::optional<TreeHeader> read_header(std::istream& file) {
  TreeHeader header;
  for (std::string line; std::getline(file, line);) {
    std::istringstream words(line);
    std::string key;
    words >> key;
    if (key == "id") words >> header.id;
    if (key == "size") words >> header.nodes;
    if (key == "res") words >> header.resolution_m;
    if (key == "data") return header;
  }
  return {};
}

/// By hand, since AbstractOcTree::read() writes to stderr about what it does.
Expected<std::unique_ptr<ColorOcTree>> read_map(const fs::path& map_ot) {
  std::ifstream file(map_ot, std::ios::binary);
  if (!file) {
    return make_error(ExitCode::kMissingInput,
                      "there is no " + map_ot.string() + "; the map server writes it at the end");
  }
  const auto header = read_header(file);
  if (!header || header->id != "ColorOcTree" || !(header->resolution_m > 0.0)) {
    return make_error(ExitCode::kBadData,
                      map_ot.string() + " is no colour octree; run the sequence again");
  }
  auto tree = std::make_unique<ColorOcTree>(header->resolution_m);
  if (header->nodes > 0) tree->readData(file);
  if (file && tree->size() == header->nodes) return tree;
  return make_error(ExitCode::kBadData,
                    map_ot.string() + " is truncated or damaged; run the sequence again");
}

}  // namespace

cv::Mat picture_of_map(const ColorOcTree& tree) {
  const MapExtent extent = extent_of(tree);
  const Eigen::Vector3d eye_m = best_eye(tree, extent);
  const render::Mesh mesh = make_map_mesh(tree, eye_m);
  if (mesh.triangles.empty()) return {};
  const SE3 T_map_camera = render::look_at(eye_m, extent.centre_m());
  render::Stage stage({{mesh, 1}}, {}, lamps_for(extent, eye_m));
  render::Renderer renderer(framing_camera(mesh, T_map_camera));
  const render::Picture picture = renderer.render(stage, render::Shot::still(T_map_camera));
  cv::Mat radiance = picture.radiance.clone();
  radiance.setTo(cv::Scalar::all(kBackground), picture.tags == 0);
  return render::to_srgb(radiance);
}

Expected<void> draw_map(const fs::path& map_ot, const fs::path& png) {
  const auto tree = read_map(map_ot);
  if (!tree) return tl::unexpected(tree.error());
  if (!has_occupied_leaf(**tree)) {
    return make_error(ExitCode::kEmptyInput,
                      map_ot.string() + " has no occupied leaf; was anything tracked?");
  }
  const cv::Mat picture = picture_of_map(**tree);
  if (picture.empty()) {
    return make_error(ExitCode::kEmptyInput,
                      map_ot.string() + " has nothing that borders on free space; run it again");
  }
  std::vector<unsigned char> bytes;
  cv::imencode(".png", picture, bytes);
  return write_file_atomically(png, std::string(bytes.begin(), bytes.end()));
}

}  // namespace tsg
