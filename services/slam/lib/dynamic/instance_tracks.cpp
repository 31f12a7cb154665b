#include "services/slam/lib/dynamic/instance_tracks.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "common/core/time.hpp"
#include "services/slam/lib/dynamic/body_region.hpp"
#include "services/slam/lib/dynamic/class_policy.hpp"
#include "services/slam/lib/dynamic/depth_cells.hpp"
#include "services/slam/lib/nearest_depth.hpp"

namespace tsg {
namespace {

constexpr std::size_t kMinPoints = 12;          // cells; less is noise at the end of range
constexpr double kMaxSpeed = 2.5;               // m/s; a faster one is two things taken for one
constexpr double kSameRadius = 0.4;             // metres: how far a centre jumps between masks
constexpr std::int64_t kTrailNs = 400'000'000;  // speed over less is noise of the mask's edge
constexpr std::int64_t kMinTrailNs = 90'000'000;
constexpr double kMinSpeed = 0.08;      // m/s; slower than the centre of a mask wanders
constexpr int kMaxMissedMasks = 3;      // networks lose a thing for a mask or two
constexpr double kNearForSensor = 0.8;  // metres; a limb may be nearer, where nothing is measured
constexpr double kMinSupport = 0.4;     // share of a missed thing that is still there

Eigen::Vector3d median_of(const std::vector<Eigen::Vector3d>& points) {
  Eigen::Vector3d median;
  std::vector<double> values(points.size());
  for (int axis = 0; axis < 3; ++axis) {
    std::ranges::transform(points, values.begin(), [axis](const auto& p) { return p[axis]; });
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::ranges::nth_element(values, middle);
    median[axis] = *middle;
  }
  return median;
}

void note_place(InstanceTrack& track, const Eigen::Vector3d& centre) {
  track.trail.push_back({track.stamp_ns, centre});
  while (track.trail.size() > 2 && track.stamp_ns - track.trail[1].stamp_ns >= kTrailNs) {
    track.trail.pop_front();
  }
  track.v_world.setZero();
  const std::int64_t span_ns = track.stamp_ns - track.trail.front().stamp_ns;
  if (span_ns < kMinTrailNs) return;
  const Eigen::Vector3d v_world = (centre - track.trail.front().centre) / to_seconds(span_ns);
  if (v_world.norm() >= kMinSpeed && v_world.norm() <= kMaxSpeed) track.v_world = v_world;
}

/// Whether a point that is expected at `depth` may be what the sensor sees there (metres, 0 =
/// nothing). Walls are beyond its range more often than people are too dark for it: without a depth
/// what moves is not there, unless it has come too close. Of what has stood still for long nobody
/// knows how it came: rather drop a feature there.
bool may_be_at(double depth, double seen, double tolerance_m, bool moves) {
  if (seen > 0.0) return std::abs(seen - depth) <= tolerance_m;
  return !moves || depth < kNearForSensor;
}

/// The sensor misses parts of hair and of dark cloth.
void close_holes(const cv::Mat& depth, cv::Mat& marked) {
  static const cv::Mat kHole = cv::getStructuringElement(cv::MORPH_RECT, {5, 5});
  cv::Mat closed;
  cv::morphologyEx(marked, closed, cv::MORPH_CLOSE, kHole);
  marked.setTo(255, closed & (depth <= 0.0));
}

/// Where nothing else is marked yet.
void add_region(const cv::Mat& marked, std::size_t i, cv::Mat& located) {
  located.setTo(static_cast<double>(i + 1), marked & (located == 0));
}

}  // namespace

InstanceTracks::InstanceTracks(DynamicFilterConfig config, const CameraModel& cell_camera)
    : config_(std::move(config)), camera_(cell_camera) {}

void InstanceTracks::take_in(const InstanceSegmentation& mask,
                             const PastFrame& frame,
                             const SE3& T_world_camera) {
  std::vector<InstanceTrack> seen = measure(mask, frame, T_world_camera);
  track_of_label_.assign(seen.size(), -1);
  for (InstanceTrack& track : tracks_) track.missed_masks += track.is_named() ? 1 : 0;
  std::vector<bool> taken(tracks_.size(), false);
  for (std::size_t label = 0; label < seen.size(); ++label) {
    if (seen[label].points.size() < kMinPoints) continue;
    int same = find_same(seen[label], taken);
    if (same < 0) {
      same = static_cast<int>(tracks_.size());
      tracks_.emplace_back().id = next_id_++;
      taken.push_back(true);
    }
    const auto i = static_cast<std::size_t>(same);
    taken[i] = true;
    track_of_label_[label] = same;
    follow(tracks_[i], std::move(seen[label]));
  }
  drop_lost(frame, T_world_camera);
  located_by_mask_ = mark_exact(mask, frame.depth);
  background_.note(frame.depth, located_by_mask_, T_world_camera);
}

/// What the mask shows of things that may move, by label.
std::vector<InstanceTrack> InstanceTracks::measure(const InstanceSegmentation& mask,
                                                   const PastFrame& frame,
                                                   const SE3& T_world_camera) const {
  const VerdictOfLabel verdict_of = verdict_of_labels(mask, config_);
  std::vector<InstanceTrack> by_label(mask.instances.size() + 1);
  for (int y = 0; y < camera_.height; ++y) {
    for (int x = 0; x < camera_.width; ++x) {
      const std::size_t label = mask.labels.at<std::uint8_t>(pixel_of_cell(x, y));
      if (verdict_of[label] == FeatureVerdict::kStatic || label >= by_label.size()) continue;
      const float depth = frame.depth.at<float>(y, x);
      if (depth < kMinDepth) continue;
      const auto cell = Eigen::Vector2d(x, y);
      by_label[label].points.push_back(T_world_camera * camera_.unproject(cell, depth));
    }
  }
  for (std::size_t label = 1; label < by_label.size(); ++label) {
    by_label[label].class_name = mask.instances[label - 1].class_name;
    by_label[label].prior = verdict_of[label];
    by_label[label].stamp_ns = frame.stamp_ns;
  }
  return by_label;
}

/// The track of the same class whose place fits best; -1 where none does.
int InstanceTracks::find_same(const InstanceTrack& seen, const std::vector<bool>& taken) const {
  const Eigen::Vector3d centre = median_of(seen.points);
  int best = -1;
  double least = kSameRadius;
  for (std::size_t i = 0; i < taken.size(); ++i) {
    if (taken[i] || tracks_[i].class_name != seen.class_name) continue;
    const double seconds = to_seconds(seen.stamp_ns - tracks_[i].stamp_ns);
    const Eigen::Vector3d expected = tracks_[i].trail.back().centre + seconds * tracks_[i].v_world;
    const double distance = (centre - expected).norm();
    if (distance >= least) continue;
    least = distance;
    best = static_cast<int>(i);
  }
  return best;
}

void InstanceTracks::follow(InstanceTrack& track, InstanceTrack seen) {
  if (seen.points.size() < kMinPoints) return;
  track.class_name = std::move(seen.class_name);
  track.prior = seen.prior;
  track.points = std::move(seen.points);
  track.stamp_ns = seen.stamp_ns;
  track.missed_masks = 0;
  note_place(track, median_of(track.points));
}

/// Those that no mask has shown lately, or where there is nothing any more.
void InstanceTracks::drop_lost(const PastFrame& frame, const SE3& T_world_camera) {
  const SE3 T_camera_world = T_world_camera.inverse();
  std::vector<int> new_index(tracks_.size(), -1);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < tracks_.size(); ++i) {
    if (tracks_[i].missed_masks > kMaxMissedMasks) continue;
    if (tracks_[i].missed_masks > 0 &&
        support(tracks_[i], frame, T_camera_world).share() < kMinSupport)
      continue;
    new_index[i] = static_cast<int>(kept);
    if (kept != i) tracks_[kept] = std::move(tracks_[i]);
    ++kept;
  }
  tracks_.resize(kept);
  for (int& track : track_of_label_) {
    if (track >= 0) track = new_index[static_cast<std::size_t>(track)];
  }
}

InstanceTracks::Support InstanceTracks::support(const InstanceTrack& track,
                                                const PastFrame& frame,
                                                const SE3& T_camera_world) const {
  Support support;
  for_each_cell(track, frame.stamp_ns, T_camera_world, [&](const cv::Point& cell, double depth) {
    const double seen = frame.depth.at<float>(cell);
    ++support.in_view;
    if (seen > 0.0 && std::abs(seen - depth) <= config_.depth_tolerance_m) ++support.there;
  });
  return support;
}

template <typename Visit>
void InstanceTracks::for_each_cell(const InstanceTrack& track,
                                   std::int64_t stamp_ns,
                                   const SE3& T_camera_world,
                                   const Visit& visit) const {
  const Eigen::Matrix3d R = T_camera_world.rotation_matrix();
  // Without a name it is seen while it moves only: later it stands where it was seen last.
  const bool goes_on = track.is_named() || track.is_moving();
  const double seconds = goes_on ? to_seconds(stamp_ns - track.stamp_ns) : 0.0;
  const Eigen::Vector3d shift = seconds * track.v_world;
  const Eigen::Vector3d t = R * shift + T_camera_world.translation();
  for (const Eigen::Vector3d& point : track.points) {
    const Eigen::Vector3d p_camera = R * point + t;
    if (p_camera.z() < kMinDepth) continue;
    const Eigen::Vector2d pixel = camera_.project(p_camera);
    if (!camera_.contains(pixel)) continue;
    visit(cv::Point(cvRound(pixel.x()), cvRound(pixel.y())), p_camera.z());
  }
}

cv::Mat InstanceTracks::locate(const PastFrame& frame,
                               const SE3& T_world_camera,
                               bool is_of_mask) const {
  cv::Mat located;
  cv::Mat background;
  if (is_of_mask) {
    located = located_by_mask_.clone();
  } else {
    located = cv::Mat::zeros(camera_.height, camera_.width, CV_8UC1);
    background = background_.find(camera_, frame.depth, T_world_camera);
  }
  const SE3 T_camera_world = T_world_camera.inverse();
  // A mask knows better where a thing ends, so that what has a name comes first.
  for (const bool named : {true, false}) {
    for (std::size_t i = 0; i < tracks_.size(); ++i) {
      if (tracks_[i].is_named() != named) continue;
      if (is_of_mask && named && tracks_[i].missed_masks == 0) continue;
      mark_carried(i, frame, T_camera_world, background, located);
    }
  }
  return located;
}

cv::Mat InstanceTracks::mark_exact(const InstanceSegmentation& mask, const cv::Mat& depth) const {
  cv::Mat located = cv::Mat::zeros(camera_.height, camera_.width, CV_8UC1);
  std::vector<std::vector<double>> depths(tracks_.size());
  for (int y = 0; y < located.rows; ++y) {
    for (int x = 0; x < located.cols; ++x) {
      const std::size_t label = mask.labels.at<std::uint8_t>(pixel_of_cell(x, y));
      const int track = label < track_of_label_.size() ? track_of_label_[label] : -1;
      if (track < 0) continue;
      located.at<std::uint8_t>(y, x) = static_cast<std::uint8_t>(track + 1);
      const double z = depth.at<float>(y, x);
      if (z > 0.0) depths[static_cast<std::size_t>(track)].push_back(z);
    }
  }
  // The rim that a mask lacks: as long as most of what lies beside it is the same surface.
  for (std::size_t i = 0; i < tracks_.size(); ++i) {
    if (!tracks_[i].is_moving() || depths[i].empty()) continue;
    cv::Mat marked = located == static_cast<double>(i + 1);
    complete_body(depth, usual_range(depths[i]), config_.depth_tolerance_m, marked);
    add_region(marked, i, located);
  }
  return located;
}

void InstanceTracks::mark_carried(std::size_t i,
                                  const PastFrame& frame,
                                  const SE3& T_camera_world,
                                  const cv::Mat& background,
                                  cv::Mat& located) const {
  const InstanceTrack& track = tracks_[i];
  const double age_s = to_seconds(frame.stamp_ns - track.stamp_ns);
  const bool spreads = track.is_named() && track.is_moving();
  const double reach_m = spreads ? config_.max_speed_mps * age_s : 0.0;
  const double tolerance_m = config_.depth_tolerance_m + reach_m;
  cv::Mat free = frame.depth;  // to be taken by what the latest mask shows
  if (track.is_named() && track.missed_masks == 0) {
    free = frame.depth.clone();
    free.setTo(0.0, background);
  }
  cv::Mat marked = cv::Mat::zeros(located.size(), CV_8UC1);
  std::vector<double> depths;
  for_each_cell(track, frame.stamp_ns, T_camera_world, [&](const cv::Point& cell, double depth) {
    depths.push_back(depth);
    const float seen = frame.depth.at<float>(cell);
    const bool is_background = seen > 0.0F && free.at<float>(cell) <= 0.0F;
    if (is_background || !may_be_at(depth, seen, tolerance_m, spreads)) return;
    marked.at<std::uint8_t>(cell) = 255;
  });
  if (depths.empty()) return;
  const DepthRange range = usual_range(depths);
  const int reach = static_cast<int>(std::lround(reach_m * camera_.fx / range.nearest));
  grow_over_surface(free,
                    {.nearest = static_cast<float>(range.nearest - tolerance_m),
                     .farthest = static_cast<float>(range.farthest + tolerance_m),
                     .steps = spreads ? std::max(reach, kEdgeCells) : 1},
                    marked);
  if (spreads) close_holes(frame.depth, marked);
  add_region(marked, i, located);
}

void InstanceTracks::move_world(const SE3& T_moved_world) {
  background_.move_world(T_moved_world);
  for (InstanceTrack& track : tracks_) {
    for (Eigen::Vector3d& point : track.points) point = T_moved_world * point;
    for (InstanceTrack::Place& place : track.trail) place.centre = T_moved_world * place.centre;
    track.v_world = T_moved_world.rotation() * track.v_world;
  }
}

}  // namespace tsg
