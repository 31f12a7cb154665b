#include "services/tsgctl/map_eval/map_evaluation.hpp"

#include <algorithm>
#include <map>
#include <opencv2/core.hpp>
#include <utility>

#include "services/map_server/lib/ply.hpp"
#include "services/tsgctl/bench/process_use.hpp"

namespace tsg {
namespace {

/// A map cannot be blamed for a thing that was seen less often or smaller than this.
constexpr int kMinViews = 3;
constexpr double kMinImageShare = 0.002;  // 600 pixels of a VGA image

/// In how many keyframes each object was well in view, by its id, and when.
using Views = std::map<int, std::vector<std::int64_t>>;

/// Pixels of each instance whose depth the map can use.
std::vector<int> measured_pixels(const RgbdFrame& frame,
                                 const InstanceSegmentation& mask,
                                 const DepthFilterConfig& depth) {
  const double units = frame.depth_units_per_metre;
  std::vector<int> pixels(mask.instances.size() + 1, 0);
  for (int v = 0; v < mask.labels.rows; ++v) {
    const auto* labels = mask.labels.ptr<std::uint8_t>(v);
    const auto* raw = frame.depth.ptr<std::uint16_t>(v);
    for (int u = 0; u < mask.labels.cols; ++u) {
      const double depth_m = raw[u] / units;
      if (depth_m >= depth.min_depth_m && depth_m <= depth.max_depth_m) ++pixels[labels[u]];
    }
  }
  return pixels;
}

class Evaluation {
 public:
  Evaluation(const MapEvalOptions& options, MapSequence sequence)
      : options_(options), sequence_(std::move(sequence)), map_(config()) {}

  void add(const PlannedKeyframe& planned);
  [[nodiscard]] MapEvalReport report();

 private:
  [[nodiscard]] MapConfig config() const {
    MapConfig config = options_.map;
    if (!options_.exclude) config.exclusion.dynamic_classes.clear();
    return config;
  }
  void count_views(const PlannedKeyframe& planned, const RgbdFrame& frame);
  [[nodiscard]] std::vector<ExpectedObject> expected(const SceneTruth& truth) const;

  const MapEvalOptions& options_;
  MapSequence sequence_;
  SemanticMap map_;
  Views views_;
  PointCounts points_;
  std::vector<double> times_ms_;
};

void Evaluation::add(const PlannedKeyframe& planned) {
  MapKeyframe keyframe{.id = planned.frame,
                       .T_world_camera = planned.T_world_camera,
                       .frame = value_or_throw(read_frame(sequence_.folder, planned.frame)),
                       .has_labels = true,
                       .instances = planned.instances};
  points_.measured += static_cast<std::size_t>(cv::countNonZero(keyframe.frame.depth));
  count_views(planned, keyframe.frame);
  if (!options_.exclude) {
    for (Instance& instance : keyframe.instances.instances) {
      instance.motion = MotionVerdict::kUnknown;
    }
  }
  const std::int64_t start_ns = thread_cpu_ns();
  const auto integrated = map_.integrate(keyframe);
  times_ms_.push_back(static_cast<double>(thread_cpu_ns() - start_ns) * 1e-6);
  if (!integrated) return;  // refused as the map server would; the report counts the others
  points_.kept += integrated->points_raw;
  points_.in_voxels += integrated->points;
}

void Evaluation::count_views(const PlannedKeyframe& planned, const RgbdFrame& frame) {
  const std::vector<int> pixels = measured_pixels(frame, planned.instances, options_.map.depth);
  const double needed = kMinImageShare * static_cast<double>(frame.depth.total());
  for (std::size_t i = 0; i < planned.ids.size(); ++i) {
    if (pixels[i + 1] >= needed) views_[planned.ids[i]].push_back(frame.stamp_ns);
  }
}

std::vector<ExpectedObject> Evaluation::expected(const SceneTruth& truth) const {
  const std::int64_t end_ns = sequence_.folder.frames[sequence_.keyframes.back().frame].stamp_ns;
  std::vector<ExpectedObject> objects;
  for (const TrueObject& object : truth.objects) {
    const TrueBox& box = object.box_at(end_ns);
    const auto seen = views_.find(object.id);
    const auto views =
        seen == views_.end() ? 0 : std::ranges::count_if(seen->second, [&](std::int64_t stamp_ns) {
          return stamp_ns >= box.from_ns;
        });
    objects.push_back({.id = object.id,
                       .class_name = object.class_name,
                       .name = object.name,
                       .box = box,
                       .is_well_seen = views >= kMinViews});
  }
  return objects;
}

MapEvalReport Evaluation::report() {
  MapEvalReport report;
  const MapSummary summary = map_.summary();
  const Cloud cloud = map_.static_cloud();
  report.keyframes = summary.keyframes;
  report.points = points_;
  report.points.stitched = map_.occupied_cloud().size();
  report.points.left = cloud.size();
  report.leaves = summary.leaves;
  report.bytes = {.cloud = to_ply(cloud, map_.classes()).size(),
                  .ot = map_.octree().to_ot().size(),
                  .bt = map_.octree().to_bt().size()};
  report.integration_ms = summarise(times_ms_);
  if (!has_scene_truth(sequence_.folder.path)) return report;
  const SceneTruth truth = value_or_throw(read_scene_truth(sequence_.folder.path));
  report.traces = score_traces(map_.octree(), truth);
  report.objects = score_objects(map_.tags().tags(), expected(truth));
  return report;
}

const char* name_of(PoseSource source) {
  switch (source) {
    case PoseSource::kTruth:
      return "truth";
    case PoseSource::kFile:
      return "file";
    case PoseSource::kSlam:
      break;
  }
  return "slam";
}

}  // namespace

MapEvalReport evaluate_map(
    const MapEvalOptions& options,
    const std::function<void(const char* what, std::size_t done, std::size_t total)>& on_progress) {
  MapSequence sequence = plan_keyframes(options.sequence, [&](std::size_t done, std::size_t total) {
    on_progress("tracking", done, total);
  });
  const std::vector<PlannedKeyframe> keyframes = sequence.keyframes;
  Evaluation evaluation(options, std::move(sequence));
  for (std::size_t i = 0; i < keyframes.size(); ++i) {
    evaluation.add(keyframes[i]);
    on_progress("mapping", i + 1, keyframes.size());
  }
  MapEvalReport report = evaluation.report();
  report.sequence = options.sequence.folder.lexically_normal().string();
  report.poses = name_of(options.sequence.poses);
  report.exclude = options.exclude;
  return report;
}

}  // namespace tsg
