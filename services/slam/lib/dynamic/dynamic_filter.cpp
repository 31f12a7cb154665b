#include "services/slam/lib/dynamic/dynamic_filter.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "common/core/time.hpp"
#include "services/slam/lib/dynamic/class_policy.hpp"

namespace tsg {
namespace {

constexpr int kReduction = 4;               // side of a full-size square that becomes one pixel
constexpr std::size_t kPastFrames = 32;     // a second, as masks come late
constexpr std::size_t kMinBodyPoints = 12;  // small pixels; less is noise at the end of range
constexpr double kMaxBodySpeed = 2.5;       // m/s; a faster "body" is two instances taken for one
constexpr double kUnknownDepth = 2.0;       // metres, for masks of frames that were never seen
constexpr double kOnSurface = 0.1;          // metres; what lies deeper is not the body
constexpr float kMinDepth = 0.1F;           // metres
constexpr float kConnectedStep = 0.04F;     // relative depth step within one surface
constexpr std::uint8_t kMarked = 255;

/// Nearest valid raw depth of the inner four pixels of square `x`; 0 where there is none. The
/// nearest, as what moves usually stands in front.
std::uint16_t nearest_of(const std::uint16_t* upper, const std::uint16_t* lower, int x) {
  const int left = x * kReduction + 1;
  std::uint16_t nearest = 0;
  for (const std::uint16_t raw : {upper[left], upper[left + 1], lower[left], lower[left + 1]}) {
    if (raw > 0 && (nearest == 0 || raw < nearest)) nearest = raw;
  }
  return nearest;
}

/// Depth of each square in metres; 0 where there is none.
cv::Mat reduce_depth(const RgbdFrame& frame) {
  cv::Mat small(frame.depth.rows / kReduction, frame.depth.cols / kReduction, CV_32FC1);
  const auto metres_per_unit = static_cast<float>(1.0 / frame.depth_units_per_metre);
  for (int y = 0; y < small.rows; ++y) {
    const auto* upper = frame.depth.ptr<std::uint16_t>(y * kReduction + 1);
    const auto* lower = frame.depth.ptr<std::uint16_t>(y * kReduction + 2);
    for (int x = 0; x < small.cols; ++x) {
      small.at<float>(y, x) = static_cast<float>(nearest_of(upper, lower, x)) * metres_per_unit;
    }
  }
  return small;
}

CameraModel reduced(const CameraModel& camera) {
  CameraModel small = camera;
  small.width = camera.width / kReduction;
  small.height = camera.height / kReduction;
  // Pixel centres are at integers, so the image's corner is at (-0.5, -0.5).
  small.fx = camera.fx / kReduction;
  small.fy = camera.fy / kReduction;
  small.cx = (camera.cx + 0.5) / kReduction - 0.5;
  small.cy = (camera.cy + 0.5) / kReduction - 0.5;
  return small;
}

cv::Point full_pixel(int small_x, int small_y) {
  return {small_x * kReduction + kReduction / 2, small_y * kReduction + kReduction / 2};
}

Eigen::Vector3d median_of(const std::vector<Eigen::Vector3d>& points) {
  Eigen::Vector3d median;
  std::vector<double> values(points.size());
  for (int axis = 0; axis < 3; ++axis) {
    std::transform(points.begin(), points.end(), values.begin(),
                   [axis](const auto& point) { return point[axis]; });
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    median[axis] = *middle;
  }
  return median;
}

/// Depths that a body can have, metres.
struct DepthRange {
  float nearest = 0.0F;
  float farthest = 0.0F;
};

/// Marks the neighbours of `from` that belong to the same surface and adds them to `next`.
void spread(const cv::Mat& depth,
            const DepthRange& range,
            const cv::Point& from,
            cv::Mat& marked,
            std::vector<cv::Point>& next) {
  const cv::Rect inside(0, 0, depth.cols, depth.rows);
  const float here = depth.at<float>(from);
  for (const cv::Point& side :
       {cv::Point(1, 0), cv::Point(-1, 0), cv::Point(0, 1), cv::Point(0, -1)}) {
    const cv::Point to = from + side;
    if (!inside.contains(to) || marked.at<std::uint8_t>(to) != 0) continue;
    const float there = depth.at<float>(to);
    if (there < range.nearest || there > range.farthest) continue;
    if (here > 0.0F && std::abs(there - here) > kConnectedStep * here) continue;
    marked.at<std::uint8_t>(to) = kMarked;
    next.push_back(to);
  }
}

/// Marks what is connected to the marked pixels in `depth`, `steps` pixels far at most.
void grow(const cv::Mat& depth, const DepthRange& range, int steps, cv::Mat& marked) {
  std::vector<cv::Point> front;
  cv::findNonZero(marked, front);
  std::vector<cv::Point> next;
  for (int step = 0; step < steps && !front.empty(); ++step) {
    next.clear();
    for (const cv::Point& from : front) spread(depth, range, from, marked, next);
    std::swap(front, next);
  }
}

}  // namespace

DynamicFilter::DynamicFilter(DynamicFilterConfig config, const CameraModel& camera)
    : config_(std::move(config)), camera_(camera), small_camera_(reduced(camera)) {}

cv::Mat DynamicFilter::judge(const RgbdFrame& frame,
                             const InstanceSegmentation* mask,
                             const SE3& T_world_camera) {
  remember(frame);
  has_new_mask_ = false;
  if (mask == nullptr || mask->frame_seq > frame.seq) return {};
  has_new_mask_ = mask_seq_ != mask->frame_seq;
  if (has_new_mask_) take_in(*mask);
  const std::uint64_t age = frame.seq - mask->frame_seq;
  if (age == 0) return exact_verdicts(*mask, config_);
  if (age > static_cast<std::uint64_t>(config_.max_mask_age_frames)) return {};
  if (placed_) return carry_forward(frame, T_world_camera);
  const double metres = config_.max_speed_mps * to_seconds(frame.stamp_ns - mask->stamp_ns);
  cv::Mat verdicts = exact_verdicts(*mask, config_);
  dilate_dynamic(verdicts, static_cast<int>(metres * camera_.fx / kUnknownDepth));
  return verdicts;
}

void DynamicFilter::note_pose(std::uint64_t seq, const SE3& T_world_camera) {
  for (PastFrame& past : past_) {
    if (past.seq == seq) past.T_world_camera = T_world_camera;
  }
}

void DynamicFilter::leave_world() {
  for (PastFrame& past : past_) past.T_world_camera.reset();
  bodies_.clear();
  placed_ = false;
}

void DynamicFilter::move_world(const SE3& T_moved_world) {
  for (PastFrame& past : past_) {
    if (past.T_world_camera) past.T_world_camera = T_moved_world * *past.T_world_camera;
  }
  for (Body& body : bodies_) {
    for (Eigen::Vector3d& point : body.points) point = T_moved_world * point;
    body.centre = T_moved_world * body.centre;
    body.v_world = T_moved_world.rotation() * body.v_world;
  }
}

bool DynamicFilter::was_dynamic(const Eigen::Vector3d& p_world) const {
  const PastFrame* past = mask_seq_ ? find_past(*mask_seq_) : nullptr;
  if (past == nullptr || !past->T_world_camera) return false;
  const Eigen::Vector3d p_camera = past->T_world_camera->inverse() * p_world;
  if (p_camera.z() < kMinDepth) return false;
  const Eigen::Vector2d pixel = small_camera_.project(p_camera);
  if (!small_camera_.contains(pixel)) return false;
  const cv::Point nearest(cvRound(pixel.x()), cvRound(pixel.y()));
  if (small_dynamic_.at<std::uint8_t>(nearest) == 0) return false;
  const double depth = past->small_depth.at<float>(nearest);
  return depth > 0.0 && std::abs(depth - p_camera.z()) < kOnSurface;
}

void DynamicFilter::remember(const RgbdFrame& frame) {
  past_.push_back({frame.seq, reduce_depth(frame), std::nullopt});
  if (past_.size() > kPastFrames) past_.pop_front();
}

void DynamicFilter::take_in(const InstanceSegmentation& mask) {
  const std::vector<Body> before = std::move(bodies_);
  bodies_.clear();
  const double seconds = mask_seq_ ? to_seconds(mask.stamp_ns - mask_stamp_ns_) : 0.0;
  mask_seq_ = mask.frame_seq;
  mask_stamp_ns_ = mask.stamp_ns;
  const VerdictOfLabel verdict_of = verdict_of_labels(mask, config_);
  small_dynamic_.create(small_camera_.height, small_camera_.width, CV_8UC1);
  for (int y = 0; y < small_dynamic_.rows; ++y) {
    for (int x = 0; x < small_dynamic_.cols; ++x) {
      const bool dynamic =
          verdict_of[mask.labels.at<std::uint8_t>(full_pixel(x, y))] == FeatureVerdict::kDynamic;
      small_dynamic_.at<std::uint8_t>(y, x) = dynamic ? kMarked : 0;
    }
  }
  const PastFrame* past = find_past(mask.frame_seq);
  placed_ = past != nullptr && past->T_world_camera.has_value();
  if (!placed_) return;
  measure_bodies(mask, *past);
  if (seconds > 0.0) estimate_velocities(before, seconds);
}

void DynamicFilter::measure_bodies(const InstanceSegmentation& mask, const PastFrame& past) {
  std::vector<Body> by_label(mask.instances.size() + 1);
  for (int y = 0; y < small_dynamic_.rows; ++y) {
    for (int x = 0; x < small_dynamic_.cols; ++x) {
      const float depth = past.small_depth.at<float>(y, x);
      const std::size_t label = mask.labels.at<std::uint8_t>(full_pixel(x, y));
      if (small_dynamic_.at<std::uint8_t>(y, x) == 0 || depth <= 0.0F) continue;
      const Eigen::Vector3d p_camera = small_camera_.unproject({x, y}, depth);
      by_label[label].points.push_back(*past.T_world_camera * p_camera);
    }
  }
  for (std::size_t label = 1; label < by_label.size(); ++label) {
    Body& body = by_label[label];
    if (body.points.size() < kMinBodyPoints) continue;
    body.class_name = mask.instances[label - 1].class_name;
    body.centre = median_of(body.points);
    bodies_.push_back(std::move(body));
  }
}

void DynamicFilter::estimate_velocities(const std::vector<Body>& before, double seconds) {
  for (Body& body : bodies_) {
    double least_speed = kMaxBodySpeed;
    for (const Body& candidate : before) {
      if (candidate.class_name != body.class_name) continue;
      const Eigen::Vector3d v_world = (body.centre - candidate.centre) / seconds;
      if (v_world.norm() > least_speed) continue;
      least_speed = v_world.norm();
      body.v_world = v_world;
    }
  }
}

cv::Mat DynamicFilter::carry_forward(const RgbdFrame& frame, const SE3& T_world_camera) const {
  const double age_s = to_seconds(frame.stamp_ns - mask_stamp_ns_);
  const SE3 T_camera_world = T_world_camera.inverse();
  cv::Mat dynamic = cv::Mat::zeros(small_camera_.height, small_camera_.width, CV_8UC1);
  for (const Body& body : bodies_) {
    cv::Mat marked = cv::Mat::zeros(dynamic.size(), CV_8UC1);
    mark_body(body, age_s, T_camera_world, marked);
    dynamic |= marked;
  }
  cv::Mat verdicts;
  cv::resize(dynamic, verdicts, frame.colour.size(), 0.0, 0.0, cv::INTER_NEAREST);
  verdicts.setTo(static_cast<double>(FeatureVerdict::kDynamic), verdicts);
  dilate_dynamic(verdicts, static_cast<int>(std::lround(config_.dilation_px)));
  return verdicts;
}

void DynamicFilter::mark_body(const Body& body,
                              double age_s,
                              const SE3& T_camera_world,
                              cv::Mat& marked) const {
  const cv::Mat& depth = past_.back().small_depth;
  const double reach_m = config_.max_speed_mps * age_s;
  const double tolerance_m = config_.depth_tolerance_m + reach_m;
  std::vector<double> depths;
  for (const Eigen::Vector3d& p_then : body.points) {
    const Eigen::Vector3d p_camera = T_camera_world * (p_then + age_s * body.v_world);
    if (p_camera.z() < kMinDepth) continue;
    depths.push_back(p_camera.z());
    const Eigen::Vector2d pixel = small_camera_.project(p_camera);
    if (!small_camera_.contains(pixel)) continue;
    const cv::Point nearest(cvRound(pixel.x()), cvRound(pixel.y()));
    const double seen = depth.at<float>(nearest);
    // Without a depth there the sensor cannot tell: rather drop a feature than keep a moving one.
    if (seen > 0.0 && std::abs(seen - p_camera.z()) > tolerance_m) continue;
    marked.at<std::uint8_t>(nearest) = kMarked;
  }
  if (depths.empty()) return;
  std::sort(depths.begin(), depths.end());
  const double nearest = depths[depths.size() / 20];
  const double farthest = depths[depths.size() - 1 - depths.size() / 20];
  const int steps = 1 + static_cast<int>(std::lround(reach_m * small_camera_.fx / nearest));
  const DepthRange range{static_cast<float>(nearest - tolerance_m),
                         static_cast<float>(farthest + tolerance_m)};
  grow(depth, range, steps, marked);
}

const DynamicFilter::PastFrame* DynamicFilter::find_past(std::uint64_t seq) const {
  const auto past = std::find_if(past_.begin(), past_.end(),
                                 [seq](const PastFrame& frame) { return frame.seq == seq; });
  return past == past_.end() ? nullptr : &*past;
}

}  // namespace tsg
