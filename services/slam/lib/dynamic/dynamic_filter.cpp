#include "services/slam/lib/dynamic/dynamic_filter.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "common/core/time.hpp"
#include "services/slam/lib/dynamic/class_policy.hpp"
#include "services/slam/lib/dynamic/depth_cells.hpp"
#include "services/slam/lib/dynamic/epipolar_coupling.hpp"
#include "services/slam/lib/dynamic/seen_through.hpp"
#include "services/slam/lib/nearest_depth.hpp"

namespace tsg {
namespace {

constexpr double kUnknownDepth = 2.0;  // metres, for masks of frames that were never seen
constexpr double kOnSurface = 0.1;     // metres; what lies deeper is not the thing
constexpr std::size_t kMaxAsked = 64;  // of the features of one thing, who else moved alike
constexpr int kMinAppearedCells = 24;  // specks are noise at the end of range
constexpr std::int64_t kDoubtNs = 1'000'000'000;  // after something nameless was last seen to move
constexpr float kFarthest = 100.0F;               // metres: any depth
constexpr int kRimCells = 2;  // around what appeared: silhouettes are left to it
/// How long ago depth is compared with: fast things show in the first, slow ones in the last.
constexpr std::array<std::int64_t, 3> kDepthAges{200'000'000, 700'000'000, 1'200'000'000};
/// How long ago features are compared with, the first two that are there: the longer, the more
/// parallax and the more motion, until looks change.
constexpr std::array<std::int64_t, 5> kFeatureAges{900'000'000, 400'000'000, 200'000'000,
                                                   120'000'000, 60'000'000};

cv::Point cell_of(const Feature& feature) {
  return {feature.raw_x / kCellSide, feature.raw_y / kCellSide};
}

/// How many of them moved alike: the others are wrong matches.
int largest_company(const std::vector<FeatureMotion>& moved) {
  std::ptrdiff_t most = 0;
  const std::size_t step = 1 + moved.size() / kMaxAsked;
  for (std::size_t i = 0; i < moved.size(); i += step) {
    most = std::max(most, std::ranges::count_if(moved, [&](const FeatureMotion& other) {
                      return moved_alike(moved[i], other);
                    }));
  }
  return static_cast<int>(most);
}

/// Cells without depth beside what moves are its shadow in the sensor's light.
void add_shadow(const cv::Mat& depth, cv::Mat& moving) {
  cv::Mat near;
  cv::dilate(moving, near, cv::Mat(), {-1, -1}, kRimCells);
  moving.setTo(255, near & (depth <= 0.0));
}

}  // namespace

DynamicFilter::DynamicFilter(const SlamConfig& config, const ObservationModel& model)
    : config_(config.dynamic_filter),
      model_(model),
      cell_camera_(camera_of_cells(model.camera())),
      tracks_(config_, cell_camera_) {}

bool DynamicFilter::leaves_out_by_class() const {
  return config_.method == DynamicMethod::kMask || config_.method == DynamicMethod::kFull;
}

cv::Mat DynamicFilter::judge_by_class(const RgbdFrame& frame,
                                      const InstanceSegmentation* mask,
                                      const SE3& T_world_camera) {
  const bool needs_depth = config_.method == DynamicMethod::kFull;
  past_.add({.seq = frame.seq,
             .stamp_ns = frame.stamp_ns,
             .depth = needs_depth ? depth_of_cells(frame) : cv::Mat()});
  has_new_mask_ = false;
  located_.release();
  uses_mask_ =
      uses_masks(config_.method) && mask != nullptr && mask->frame_seq <= frame.seq &&
      frame.seq - mask->frame_seq <= static_cast<std::uint64_t>(config_.max_mask_age_frames);
  if (config_.method == DynamicMethod::kFull) return judge_by_place(frame, mask, T_world_camera);
  return uses_mask_ ? exact_verdicts(*mask, config_) : cv::Mat();
}

cv::Mat DynamicFilter::judge_by_place(const RgbdFrame& frame,
                                      const InstanceSegmentation* mask,
                                      const SE3& T_world_camera) {
  if (!uses_mask_) tracks_.drop_named();
  tracks_.drop_unnamed(past_.now(), T_world_camera);
  if (!uses_mask_ || take_in(*mask, T_world_camera)) {
    if (tracks_.tracks().empty()) return {};
    const bool is_exact = uses_mask_ && mask->frame_seq == frame.seq;
    located_ = tracks_.locate(past_.now(), T_world_camera, is_exact);
    return by_place(is_exact ? mask : nullptr, frame.colour.size());
  }
  // Nobody knows from where that mask was seen: it is believed as it is, with room to move.
  const double metres = config_.max_speed_mps * to_seconds(frame.stamp_ns - mask->stamp_ns);
  cv::Mat verdicts = exact_verdicts(*mask, config_);
  dilate_dynamic(verdicts, static_cast<int>(metres * model_.camera().fx / kUnknownDepth));
  return verdicts;
}

/// False where the place of the mask's frame is not known.
bool DynamicFilter::take_in(const InstanceSegmentation& mask, const SE3& T_world_camera) {
  const PastFrame* frame = past_.find(mask.frame_seq);
  if (frame == nullptr) return false;
  if (mask_seq_ == mask.frame_seq) return !mask_dynamic_.empty();
  has_new_mask_ = true;
  mask_seq_ = mask.frame_seq;
  mask_dynamic_.release();
  const bool is_now = frame == &past_.now();
  if (!is_now && !frame->T_world_camera) return false;
  tracks_.take_in(mask, *frame, is_now ? T_world_camera : *frame->T_world_camera);
  const VerdictOfLabel verdict_of = verdict_of_labels(mask, config_);
  mask_dynamic_.create(cell_camera_.height, cell_camera_.width, CV_8UC1);
  for (int y = 0; y < mask_dynamic_.rows; ++y) {
    for (int x = 0; x < mask_dynamic_.cols; ++x) {
      const std::uint8_t label = mask.labels.at<std::uint8_t>(pixel_of_cell(x, y));
      const bool dynamic = verdict_of[label] == FeatureVerdict::kDynamic;
      mask_dynamic_.at<std::uint8_t>(y, x) = dynamic ? 255 : 0;
    }
  }
  return true;
}

/// By where the tracks are, and where the mask is of this very frame by its pixels too.
cv::Mat DynamicFilter::by_place(const InstanceSegmentation* exact, const cv::Size& size) const {
  cv::Mat table = cv::Mat::zeros(1, 256, CV_8UC1);
  for (std::size_t i = 0; i < tracks_.tracks().size(); ++i) {
    table.at<std::uint8_t>(static_cast<int>(i) + 1) =
        static_cast<std::uint8_t>(tracks_.tracks()[i].prior);
  }
  cv::Mat cells;
  cv::LUT(located_, table, cells);
  cv::Mat dynamic = cells == static_cast<double>(FeatureVerdict::kDynamic);
  // What was carried here may have gone on to where the sensor sees nothing.
  if (exact == nullptr) add_shadow(past_.now().depth, dynamic);
  cells.setTo(static_cast<double>(FeatureVerdict::kDynamic), dynamic);
  cv::Mat verdicts = pixels_of_cells(cells, size);
  if (exact != nullptr) raise_verdicts(*exact, config_, verdicts);
  // A corner beside a silhouette is half of what moves, whatever its depth.
  dilate_dynamic(verdicts, static_cast<int>(std::lround(config_.dilation_px)));
  return verdicts;
}

Judgement DynamicFilter::judge_by_motion(const Features& features, const SE3* T_world_camera) {
  switch (config_.method) {
    case DynamicMethod::kEpipolar:
    case DynamicMethod::kTsg:
      return judge_by_epipolar(features);
    case DynamicMethod::kFull: {
      if (T_world_camera != nullptr) return judge_by_depth(features, *T_world_camera);
      Judgement by_class;
      by_class.instances = states();
      return by_class;
    }
    case DynamicMethod::kNone:
    case DynamicMethod::kMask:
      break;
  }
  return {};
}

Judgement DynamicFilter::judge_by_epipolar(const Features& features) const {
  const PastFrame* previous = past_.previous();
  if (previous == nullptr || previous->features == nullptr) return {};
  CouplingVerdicts verdicts =
      judge_by_epipolar_lines(*previous->features, features, config_.method, {});
  return {.is_dynamic = std::move(verdicts.is_dynamic),
          .is_doubtful = {},
          .epipolar_px = std::move(verdicts.epipolar_px),
          .dynamic_cells = {},
          .instances = {}};
}

Judgement DynamicFilter::judge_by_depth(const Features& features, const SE3& T_world_camera) {
  const cv::Mat evidence = compare_with_past(T_world_camera);
  const auto motion = compare_with_reference(features, T_world_camera);
  if (!located_.empty()) weigh_tracks(features, motion, evidence);
  Judgement judgement;
  judgement.is_dynamic = moving_in_company(features, motion);
  cv::Mat unnamed = appeared_regions(evidence, kMinAppearedCells);
  for (std::size_t i = 0; i < features.size(); ++i) {
    if (judgement.is_dynamic[i]) unnamed.at<std::uint8_t>(cell_of(features.items[i])) = 255;
  }
  judgement.dynamic_cells = moving_cells(unnamed);
  if (located_.empty()) located_ = cv::Mat::zeros(unnamed.size(), CV_8UC1);
  tracks_.take_in_unnamed(unnamed, located_, past_.now(), T_world_camera);
  judgement.is_doubtful = doubt(motion, std::move(unnamed));
  for (std::size_t i = 0; i < features.size(); ++i) {
    const cv::Point cell = cell_of(features.items[i]);
    if (judgement.dynamic_cells.at<std::uint8_t>(cell) != 0) judgement.is_dynamic[i] = true;
  }
  judgement.instances = states();
  return judgement;
}

/// Where something moves that no mask tells of, what was not seen to stand still may be a part of
/// it: the side of a cart that has just come into view.
std::vector<bool> DynamicFilter::doubt(const std::vector<FeatureMotion>& motion, cv::Mat moving) {
  if (!located_.empty()) moving.setTo(0, located_ != 0);
  const std::int64_t now_ns = past_.now().stamp_ns;
  if (cv::countNonZero(moving) >= kMinAppearedCells) unnamed_seen_ns_ = now_ns;
  if (!unnamed_seen_ns_ || now_ns - *unnamed_seen_ns_ > kDoubtNs) return {};
  std::vector<bool> doubtful(motion.size());
  std::transform(motion.begin(), motion.end(), doubtful.begin(),
                 [](const FeatureMotion& m) { return m.motion != Motion::kStill; });
  return doubtful;
}

cv::Mat DynamicFilter::compare_with_past(const SE3& T_world_camera) const {
  const PastFrame& now = past_.now();
  cv::Mat evidence = cv::Mat::zeros(now.depth.size(), CV_8UC1);
  for (const std::int64_t age_ns : kDepthAges) {
    const PastFrame* then = past_.before(age_ns);
    if (then == nullptr) continue;
    compare_depth(cell_camera_, {now.depth, T_world_camera}, {then->depth, *then->T_world_camera},
                  model_.inverse_depth_sigma(), evidence);
  }
  return evidence;
}

std::vector<FeatureMotion> DynamicFilter::compare_with_reference(const Features& features,
                                                                 const SE3& T_world_camera) const {
  std::vector<FeatureMotion> motion(features.size());
  const PastFrame* used = nullptr;
  for (const std::int64_t age_ns : kFeatureAges) {
    const PastFrame* then = past_.before(age_ns);
    if (then == nullptr || then->features == nullptr || then == used) continue;
    const auto found = compare_features(model_, {features, T_world_camera},
                                        {*then->features, *then->T_world_camera});
    for (std::size_t i = 0; i < motion.size(); ++i) {
      if (motion[i].motion == Motion::kUnknown) motion[i] = found[i];
    }
    if (used != nullptr) break;
    used = then;
  }
  return motion;
}

void DynamicFilter::weigh_tracks(const Features& features,
                                 const std::vector<FeatureMotion>& motion,
                                 const cv::Mat& evidence) {
  std::vector<MotionCounts> counts(tracks_.tracks().size() + 1);
  std::vector<std::vector<FeatureMotion>> moved(counts.size());
  for (std::size_t i = 0; i < features.size(); ++i) {
    const std::size_t track = located_.at<std::uint8_t>(cell_of(features.items[i]));
    if (motion[i].motion == Motion::kMoved) moved[track].push_back(motion[i]);
    if (motion[i].motion == Motion::kStill) ++counts[track].features_still;
  }
  for (std::size_t track = 1; track < counts.size(); ++track) {
    counts[track].features_moved = largest_company(moved[track]);
  }
  for (int y = 0; y < evidence.rows; ++y) {
    const auto* says = evidence.ptr<std::uint8_t>(y);
    const auto* track = located_.ptr<std::uint8_t>(y);
    for (int x = 0; x < evidence.cols; ++x) {
      const auto cell = static_cast<CellEvidence>(says[x]);
      counts[track[x]].cells_appeared += cell == CellEvidence::kAppeared ? 1 : 0;
      counts[track[x]].cells_same += cell == CellEvidence::kSame ? 1 : 0;
    }
  }
  for (std::size_t i = 0; i + 1 < counts.size(); ++i) tracks_.add_evidence(i, counts[i + 1]);
}

/// Instances that move, and what has come to where there was nothing.
cv::Mat DynamicFilter::moving_cells(const cv::Mat& unnamed) const {
  cv::Mat moving = unnamed.clone();
  grow_over_surface(past_.now().depth,
                    {.nearest = kMinDepth, .farthest = kFarthest, .steps = kRimCells}, moving);
  for (std::size_t i = 0; !located_.empty() && i < tracks_.tracks().size(); ++i) {
    if (tracks_.tracks()[i].is_moving()) moving |= located_ == static_cast<double>(i + 1);
  }
  // A corner beside a silhouette is half of what moves, whatever its depth.
  cv::dilate(moving, moving, cv::Mat());
  return moving;
}

std::vector<InstanceState> DynamicFilter::states() const {
  std::vector<InstanceState> states;
  for (std::size_t i = 0; !located_.empty() && i < tracks_.tracks().size(); ++i) {
    const InstanceTrack& track = tracks_.tracks()[i];
    const cv::Rect cells = cv::boundingRect(located_ == static_cast<double>(i + 1));
    if (cells.empty()) continue;
    states.push_back({.id = track.id,
                      .class_name = track.class_name,
                      .prior = track.prior,
                      .p_moving = track.evidence.probability(),
                      .is_moving = track.is_moving(),
                      .box = {cells.x * kCellSide, cells.y * kCellSide, cells.width * kCellSide,
                              cells.height * kCellSide}});
  }
  return states;
}

void DynamicFilter::note_pose(const SE3& T_world_camera) {
  past_.now().T_world_camera = T_world_camera;
}

void DynamicFilter::leave_world() {
  past_.forget_poses();
  tracks_.clear();
  mask_dynamic_.release();
}

void DynamicFilter::move_world(const SE3& T_moved_world) {
  past_.move_world(T_moved_world);
  tracks_.move_world(T_moved_world);
}

bool DynamicFilter::was_dynamic(const Eigen::Vector3d& p_world) const {
  const PastFrame* past = mask_seq_ ? past_.find(*mask_seq_) : nullptr;
  if (past == nullptr || !past->T_world_camera || mask_dynamic_.empty()) return false;
  const Eigen::Vector3d p_camera = past->T_world_camera->inverse() * p_world;
  if (p_camera.z() < kMinDepth) return false;
  const Eigen::Vector2d pixel = cell_camera_.project(p_camera);
  if (!cell_camera_.contains(pixel)) return false;
  const cv::Point nearest(cvRound(pixel.x()), cvRound(pixel.y()));
  if (mask_dynamic_.at<std::uint8_t>(nearest) == 0) return false;
  const double depth = past->depth.at<float>(nearest);
  return depth > 0.0 && std::abs(depth - p_camera.z()) < kOnSurface;
}

}  // namespace tsg
