#include "services/map_server/lib/semantic_map.hpp"

#include <algorithm>
#include <string_view>
#include <utility>

#include "common/core/atomic_file.hpp"
#include "services/map_server/lib/ply.hpp"

namespace tsg {
namespace {

/// Fewer points are a glimpse of an instance, or noise at the rim of another one.
constexpr std::uint32_t kMinInstancePoints = 100;

/// OctoMap numbers leaves with 16 bits along each axis, from the middle.
constexpr double kLeavesToEachSide = 32767.0;
/// A point at the maximal depth and tangent lies sqrt(1 + 3^2 + 3^2) < 5 times as far away.
constexpr double kMaxRangePerDepth = 5.0;

void append(std::vector<std::string>& list, const std::vector<std::string>& more) {
  list.insert(list.end(), more.begin(), more.end());
}

Expected<std::size_t> write_map_file(const std::filesystem::path& path, std::string_view content) {
  return write_file_atomically(path, content)
      .map([&] { return content.size(); })
      .map_error([&](Error error) {
        error.message += " (" + std::to_string(content.size()) + " bytes are needed)";
        return error;
      });
}

}  // namespace

std::vector<std::string> MapConfig::problems() const {
  std::vector<std::string> found = depth.problems();
  append(found, exclusion.problems());
  append(found, outliers.problems());
  append(found, octree.problems());
  append(found, tags.problems());
  if (!(cloud_voxel_m >= 0.002 && cloud_voxel_m <= octree.resolution_m)) {
    found.emplace_back("cloud_voxel_m must be 0.002..resolution_m");
  }
  const double reach_m = max_extent_m + kMaxRangePerDepth * depth.max_depth_m;
  if (!(max_extent_m > 0.0) || !(reach_m < kLeavesToEachSide * octree.resolution_m)) {
    found.emplace_back(
        "max_extent_m must be > 0, and with 5 * max_depth_m stay below 32767 * resolution_m, "
        "which is as far as an octree of depth 16 reaches");
  }
  return found;
}

SemanticMap::SemanticMap(const MapConfig& config)
    : config_(config),
      viewer_(config.depth, config.exclusion, config.cloud_voxel_m),
      cloud_(config.cloud_voxel_m),
      octree_(config.octree),
      tags_(config.tags) {}

Expected<Integration> SemanticMap::integrate(const MapKeyframe& keyframe) {
  if (auto checked = check_keyframe(keyframe, config_.max_extent_m); !checked) {
    return tl::unexpected(checked.error());
  }
  const KeyframeView view = viewer_.view(keyframe, classes_);
  add(view, keyframe.T_world_camera);
  return Integration{view.points_raw, view.points.size()};
}

void SemanticMap::add(const KeyframeView& view, const SE3& T_world_camera) {
  tags_.add(view, T_world_camera, [this](const Eigen::Vector3f& p) { return octree_.place_at(p); });
  const Eigen::Isometry3f T = T_world_camera.to_isometry().cast<float>();
  Cloud points = view.points;
  for (CloudPoint& point : points) {
    point.position = T * point.position;
    cloud_.add(point);
  }
  std::vector<Eigen::Vector3f> free_ends = view.free_ends;
  for (Eigen::Vector3f& end : free_ends) end = T * end;
  octree_.integrate(T_world_camera.translation(), points, free_ends, classes_);
  count_instances(view);
  ++keyframes_;
  keyframes_without_labels_ += view.has_labels ? 0 : 1;
  points_raw_ += view.points_raw;
}

void SemanticMap::count_instances(const KeyframeView& view) {
  std::map<ClassId, int> in_view;
  for (const InstanceView& seen : view.instances) {
    std::uint32_t pixels = 0;
    for (const CloudPoint& point : seen.points) pixels += point.weight;
    if (pixels >= kMinInstancePoints) ++in_view[classes_.id_of(seen.instance.class_name)];
  }
  for (const auto& [id, count] : in_view) max_in_view_[id] = std::max(max_in_view_[id], count);
}

Cloud SemanticMap::static_cloud() const {
  Cloud cloud = occupied_cloud();
  OutlierFilter(config_.outliers).apply(cloud);
  return cloud;
}

Cloud SemanticMap::occupied_cloud() const {
  Cloud cloud = cloud_.to_cloud();
  std::erase_if(
      cloud, [this](const CloudPoint& point) { return !octree_.is_occupied_at(point.position); });
  return cloud;
}

MapSummary SemanticMap::summary() const {
  const SemanticOctree::LeafCounts leaves = octree_.count_leaves();
  MapSummary summary;
  summary.keyframes = keyframes_;
  summary.keyframes_without_labels = keyframes_without_labels_;
  summary.points_raw = points_raw_;
  summary.points = static_cloud().size();
  summary.leaves = leaves.occupied;
  summary.leaves_free = leaves.free;
  std::map<std::string, int> present;
  for (const Tag& tag : tags_.tags()) present[tag.class_name] += is_present(tag) ? 1 : 0;
  for (const auto& [id, count] : max_in_view_) {
    const auto found = leaves.occupied_by_class.find(id);
    const std::size_t of_class = found == leaves.occupied_by_class.end() ? 0 : found->second;
    const std::string& name = classes_.name_of(id);
    summary.objects.push_back({name, present[name], count, of_class});
  }
  std::sort(summary.objects.begin(), summary.objects.end(),
            [](const ObjectClass& a, const ObjectClass& b) { return a.name < b.name; });
  return summary;
}

Expected<MapFiles> SemanticMap::save(const std::filesystem::path& folder) const {
  const Cloud cloud = static_cloud();
  MapFiles files;
  files.points = cloud.size();
  return make_folder(folder)
      .and_then([&] { return write_map_file(folder / "map.ot", octree_.to_ot()); })
      .and_then([&](std::size_t bytes) {
        files.bytes_ot = bytes;
        return write_map_file(folder / "map.bt", octree_.to_bt());
      })
      .and_then([&](std::size_t bytes) {
        files.bytes_bt = bytes;
        return write_map_file(folder / "cloud.ply", to_ply(cloud, classes_));
      })
      .map([&](std::size_t bytes) {
        files.bytes_ply = bytes;
        return files;
      });
}

}  // namespace tsg
