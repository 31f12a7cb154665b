// What one VGA keyframe costs, stage by stage, and its octree insertion beside OctoMap's own
// insertPointCloud() of the same cloud.

#include <benchmark/benchmark.h>
#include <octomap/ColorOcTree.h>

#include <cmath>
#include <opencv2/core.hpp>
#include <vector>

#include "services/map_server/lib/back_projection.hpp"
#include "services/map_server/lib/semantic_map.hpp"
#include "services/map_server/lib/tags/tag_library.hpp"
#include "services/map_server/lib/voxel_grid.hpp"

namespace tsg {
namespace {

constexpr int kKeyframes = 20;
const double kCloudVoxel_m = MapConfig{}.cloud_voxel_m;

/// A camera in a room of 6 m x 5 m x 2.6 m, 1.3 m above its floor, with a table and a person in
/// view; turned by 6 degrees from keyframe to keyframe, so that each sees some new space.
class Room {
 public:
  static MapKeyframe keyframe(int index) {
    MapKeyframe keyframe;
    const double yaw = index * 6.0 * M_PI / 180.0;
    Eigen::Matrix3d R_level_camera;
    R_level_camera << 0, 0, 1, -1, 0, 0, 0, -1, 0;
    const Eigen::AngleAxisd R_world_level(yaw, Eigen::Vector3d::UnitZ());
    keyframe.T_world_camera =
        SE3(Eigen::Matrix3d(R_world_level.toRotationMatrix() * R_level_camera), {0.1, 0.1, 1.3});
    keyframe.frame.camera = {640, 480, 535.4, 539.2, 320.1, 247.6, {}};
    keyframe.frame.depth_units_per_metre = 5000.0;
    render(keyframe);
    return keyframe;
  }

 private:
  static void render(MapKeyframe& keyframe) {
    RgbdFrame& frame = keyframe.frame;
    frame.colour = cv::Mat(480, 640, CV_8UC3);
    frame.depth = cv::Mat(480, 640, CV_16UC1);
    keyframe.has_labels = true;
    keyframe.instances.labels = cv::Mat1b(480, 640, std::uint8_t{0});
    keyframe.instances.instances = {{"person", 1.0F, {}, MotionVerdict::kMoving},
                                    {"dining table", 1.0F, {}, MotionVerdict::kStatic}};
    cv::RNG noise(17);
    for (int v = 0; v < 480; ++v) {
      for (int u = 0; u < 640; ++u) {
        const Eigen::Vector3d ray = frame.camera.unproject({double(u), double(v)}, 1.0);
        double depth_m = distance_to_walls(keyframe.T_world_camera, ray);
        std::uint8_t& label = keyframe.instances.labels.at<std::uint8_t>(v, u);
        if (u > 250 && u < 360 && v > 100) {
          depth_m = 1.8;
          label = 1;
        } else if (u > 400 && u < 600 && v > 260 && v < 330) {
          depth_m = std::min(depth_m, 1.5);
          label = 2;
        }
        depth_m += noise.gaussian(0.0015 * depth_m * depth_m);
        frame.depth.at<std::uint16_t>(v, u) = static_cast<std::uint16_t>(5000.0 * depth_m);
        frame.colour.at<cv::Vec3b>(v, u) = {static_cast<std::uint8_t>(u / 3),
                                            static_cast<std::uint8_t>(v / 2), 90};
      }
    }
  }

  /// Along the optical axis, for the ray through (x, y, 1) in camera axes.
  static double distance_to_walls(const SE3& T_world_camera, const Eigen::Vector3d& ray_camera) {
    const Eigen::Vector3d from = T_world_camera.translation();
    const Eigen::Vector3d along = T_world_camera.rotation() * ray_camera;
    const Eigen::Vector3d low(-3.0, -2.5, 0.0);
    const Eigen::Vector3d high(3.0, 2.5, 2.6);
    double nearest = 100.0;
    for (int axis = 0; axis < 3; ++axis) {
      const double wall = along[axis] > 0.0 ? high[axis] : low[axis];
      if (std::abs(along[axis]) > 1e-9) {
        nearest = std::min(nearest, (wall - from[axis]) / along[axis]);
      }
    }
    return nearest;
  }
};

const std::vector<MapKeyframe>& keyframes() {
  static const std::vector<MapKeyframe> made = [] {
    std::vector<MapKeyframe> all;
    for (int i = 0; i < kKeyframes; ++i) all.push_back(Room::keyframe(i));
    return all;
  }();
  return made;
}

/// What the octree gets of a keyframe.
struct Scan {
  Eigen::Vector3d origin;
  Cloud points;  ///< world
};

const std::vector<Scan>& scans() {
  static const std::vector<Scan> made = [] {
    std::vector<Scan> all;
    ClassTable classes;
    BackProjector projector({}, {});
    VoxelGrid grid(kCloudVoxel_m);
    for (const MapKeyframe& keyframe : keyframes()) {
      Cloud points = voxel_filter(projector.project(keyframe, classes).points, grid);
      const Eigen::Isometry3f T_world_camera = keyframe.T_world_camera.to_isometry().cast<float>();
      for (CloudPoint& point : points) point.position = T_world_camera * point.position;
      all.push_back({keyframe.T_world_camera.translation(), std::move(points)});
    }
    return all;
  }();
  return made;
}

void back_projection(benchmark::State& state) {
  ClassTable classes;
  BackProjector projector({}, {});
  std::size_t next = 0;
  std::size_t points = 0;
  for (auto _ : state) {
    points += projector.project(keyframes()[next++ % kKeyframes], classes).points.size();
  }
  state.SetItemsProcessed(state.iterations());
  state.counters["points"] = double(points) / double(state.iterations());
}

void keyframe_voxel_filter(benchmark::State& state) {
  ClassTable classes;
  const Cloud cloud = BackProjector({}, {}).project(keyframes()[0], classes).points;
  VoxelGrid grid(kCloudVoxel_m);
  std::size_t points = 0;
  for (auto _ : state) points = voxel_filter(cloud, grid).size();
  state.SetItemsProcessed(state.iterations());
  state.counters["points"] = double(points);
}

/// All keyframes into one empty tree; the time is that of one keyframe.
void octree_batched(benchmark::State& state) {
  (void)scans();
  const ClassTable classes;
  SemanticOctree::LeafCounts leaves;
  for (auto _ : state) {
    SemanticOctree tree{OctreeConfig{}};
    for (const Scan& scan : scans()) tree.integrate(scan.origin, scan.points, {}, classes);
    state.PauseTiming();
    leaves = tree.count_leaves();
    state.ResumeTiming();
  }
  state.SetItemsProcessed(state.iterations() * kKeyframes);
  state.counters["time_per_keyframe"] =
      benchmark::Counter(double(state.iterations()) * kKeyframes,
                         benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
  state.counters["occupied"] = double(leaves.occupied);
}

/// The same by OctoMap: insertPointCloud, then the colours; `discretised` is OctoMap's own way of
/// casting one ray for each end leaf.
void octree_by_octomap(benchmark::State& state, bool discretised) {
  (void)scans();
  std::size_t occupied = 0;
  for (auto _ : state) {
    octomap::ColorOcTree tree(0.05);
    for (const Scan& scan : scans()) {
      octomap::Pointcloud cloud;
      for (const CloudPoint& point : scan.points) {
        cloud.push_back(point.position.x(), point.position.y(), point.position.z());
      }
      const octomap::point3d origin(float(scan.origin.x()), float(scan.origin.y()),
                                    float(scan.origin.z()));
      tree.insertPointCloud(cloud, origin, -1.0, /*lazy_eval=*/true, discretised);
      for (const CloudPoint& point : scan.points) {
        const auto& [r, g, b] = point.colour;
        tree.averageNodeColor(point.position.x(), point.position.y(), point.position.z(), r, g, b);
      }
      tree.updateInnerOccupancy();
    }
    state.PauseTiming();
    occupied = 0;
    for (auto leaf = tree.begin_leafs(); leaf != tree.end_leafs(); ++leaf) {
      occupied += tree.isNodeOccupied(*leaf) ? 1 : 0;
    }
    state.ResumeTiming();
  }
  state.SetItemsProcessed(state.iterations() * kKeyframes);
  state.counters["time_per_keyframe"] =
      benchmark::Counter(double(state.iterations()) * kKeyframes,
                         benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
  state.counters["occupied"] = double(occupied);
}

/// Everything that a keyframe goes through in the service.
void whole_keyframe(benchmark::State& state) {
  (void)keyframes();
  for (auto _ : state) {
    SemanticMap map{MapConfig{}};
    for (const MapKeyframe& keyframe : keyframes())
      benchmark::DoNotOptimize(map.integrate(keyframe));
  }
  state.SetItemsProcessed(state.iterations() * kKeyframes);
  state.counters["time_per_keyframe"] =
      benchmark::Counter(double(state.iterations()) * kKeyframes,
                         benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

/// What 20 things as large as chairs look like from 3 m: 500 voxels, 3500 pixels each.
KeyframeView view_of_twenty(std::uint64_t id) {
  cv::RNG noise(id);
  KeyframeView view;
  view.id = id;
  for (int thing = 0; thing < 20; ++thing) {
    InstanceView seen{{"chair", 0.9F, {}, MotionVerdict::kStatic}, {}};
    const Eigen::Vector3f corner(0.7F * float(thing % 5), 0.7F * float(thing / 5), 3.0F);
    for (int i = 0; i < 500; ++i) {
      const Eigen::Vector3f within(0.02F * float(i % 25), 0.02F * float(i / 25),
                                   float(noise.gaussian(0.015)));
      seen.points.push_back({corner + within, {120, 90, 60}, 57, 7});
    }
    view.points.insert(view.points.end(), seen.points.begin(), seen.points.end());
    view.instances.push_back(std::move(seen));
  }
  return view;
}

/// A keyframe into the tag library; with `listed` somebody asks for the tags after each.
void tags(benchmark::State& state, bool listed) {
  std::vector<KeyframeView> views;
  for (std::uint64_t id = 0; id < kKeyframes; ++id) views.push_back(view_of_twenty(id));
  const auto occupied = [](const Eigen::Vector3f& /*position*/) { return Place::kOccupied; };
  std::size_t found = 0;
  for (auto _ : state) {
    TagLibrary library{TagConfig{}};
    for (const KeyframeView& view : views) {
      library.add(view, SE3(), occupied);
      if (listed) benchmark::DoNotOptimize(library.tags().data());
    }
    state.PauseTiming();
    found = library.tags().size();
    state.ResumeTiming();
  }
  state.SetItemsProcessed(state.iterations() * kKeyframes);
  state.counters["time_per_keyframe"] =
      benchmark::Counter(double(state.iterations()) * kKeyframes,
                         benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
  state.counters["tags"] = double(found);
}

BENCHMARK_CAPTURE(tags, alone, false)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(tags, listed_each_time, true)->Unit(benchmark::kMillisecond);
BENCHMARK(back_projection)->Unit(benchmark::kMillisecond);
BENCHMARK(keyframe_voxel_filter)->Unit(benchmark::kMillisecond);
BENCHMARK(octree_batched)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(octree_by_octomap, insertPointCloud, false)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(octree_by_octomap, discretised, true)->Unit(benchmark::kMillisecond);
BENCHMARK(whole_keyframe)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace tsg

BENCHMARK_MAIN();
