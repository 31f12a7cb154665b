// What InstanceTracks does about things that move and have no name.

#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "services/slam/lib/dynamic/body_region.hpp"
#include "services/slam/lib/dynamic/instance_tracks.hpp"
#include "services/slam/lib/nearest_depth.hpp"

namespace tsg {
namespace {

constexpr int kMinInView = 12;           // cells; by fewer nobody can tell
constexpr double kMinCellSupport = 0.4;  // share of its cells where something still is
constexpr int kJoinCells = 8;            // between parts of one thing that were seen to move
constexpr int kMinSeeds = 8;             // cells that were seen to move; fewer are chance
constexpr int kMinSeenCells = 40;        // that count as evidence at first
constexpr std::size_t kMaxTracks = 200;  // labels of cells have 8 bits
constexpr std::int64_t kAtRestNs = 20'000'000'000;  // then what had moved is furniture again
constexpr std::int64_t kUncertainNs = 500'000'000;  // what hardly moved is forgotten soon
constexpr std::int64_t kOutOfViewNs = 5'000'000'000;

}  // namespace

void InstanceTracks::take_in_unnamed(const cv::Mat& moving,
                                     const cv::Mat& located,
                                     const PastFrame& frame,
                                     const SE3& T_world_camera) {
  cv::Mat free = moving.clone();
  for (std::size_t i = 0; i < tracks_.size(); ++i) {
    if (tracks_[i].is_named()) free.setTo(0, located == static_cast<double>(i + 1));
  }
  cv::Mat joined;
  cv::dilate(free, joined, cv::Mat(), {-1, -1}, kJoinCells);
  cv::Mat labels;
  const int count = cv::connectedComponents(joined, labels, 8, CV_32S);
  for (int label = 1; label < count && tracks_.size() < kMaxTracks; ++label) {
    const cv::Mat seeds = free & (labels == label);
    if (cv::countNonZero(seeds) < kMinSeeds) continue;
    const std::size_t i = find_unnamed(seeds, located);
    const cv::Mat known = located == static_cast<double>(i + 1);
    follow(tracks_[i], seen_at(body_around(seeds, known, frame.depth), frame, T_world_camera));
  }
  std::erase_if(tracks_, [](const InstanceTrack& track) { return track.points.empty(); });
}

/// What the cells show.
InstanceTrack InstanceTracks::seen_at(const cv::Mat& cells,
                                      const PastFrame& frame,
                                      const SE3& T_world_camera) const {
  InstanceTrack seen;
  seen.stamp_ns = frame.stamp_ns;
  for (int y = 0; y < cells.rows; ++y) {
    for (int x = 0; x < cells.cols; ++x) {
      const float depth = frame.depth.at<float>(y, x);
      if (cells.at<std::uint8_t>(y, x) == 0 || depth < kMinDepth) continue;
      seen.points.push_back(T_world_camera * camera_.unproject({x, y}, depth));
    }
  }
  return seen;
}

/// The nameless track that `region` shows most of; a new one where it shows none.
std::size_t InstanceTracks::find_unnamed(const cv::Mat& region, const cv::Mat& located) {
  std::size_t best = tracks_.size();
  int most = 0;
  for (std::size_t i = 0; i < tracks_.size(); ++i) {
    if (tracks_[i].is_named()) continue;
    const int overlap = cv::countNonZero(region & (located == static_cast<double>(i + 1)));
    if (overlap <= most) continue;
    most = overlap;
    best = i;
  }
  if (best < tracks_.size()) return best;
  InstanceTrack& track = tracks_.emplace_back();
  track.id = next_id_++;
  // It was seen to move: that is all that is known of it.
  track.evidence.add({.cells_appeared = kMinSeenCells});
  return best;
}

void InstanceTracks::drop_unnamed(const PastFrame& frame, const SE3& T_world_camera) {
  const SE3 T_camera_world = T_world_camera.inverse();
  std::erase_if(tracks_, [&](const InstanceTrack& track) {
    if (track.is_named()) return false;
    const std::int64_t age_ns = frame.stamp_ns - track.stamp_ns;
    const Support seen = support(track, frame, T_camera_world);
    const bool in_view = seen.in_view >= kMinInView;
    if (in_view && seen.share() < kMinCellSupport) return true;
    if (!track.evidence.was_certain()) return age_ns > kUncertainNs;
    return age_ns > (in_view ? kAtRestNs : kOutOfViewNs);
  });
}

}  // namespace tsg
