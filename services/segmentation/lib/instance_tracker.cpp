#include "services/segmentation/lib/instance_tracker.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "common/core/time.hpp"

namespace tsg {

namespace {

constexpr int kStep = 4;  // pixels between samples: masks are that coarse anyway
constexpr double kLeastOverlap =
    0.1;  // a walker close by, at 3 Hz, keeps more of his box than that
constexpr double kPartWeight = 0.3;
// What is covered is as much bigger as its place is unsure: at once, and more each second.
constexpr double kDoubt = 0.2;
constexpr double kMoreDoubtPerSecond = 0.4;
// Less of a thing than this, in width or height, is a part of it: the rest is covered.
constexpr float kWholeShare = 0.85F;
constexpr double kVelocityMemory = 0.4;                 // seconds: boxes jitter by some pixels
constexpr std::int64_t kLongestPartNs = 2'000'000'000;  // who turned sideways stays thinner

cv::Point2f centre_of(const cv::Rect2f& box) { return (box.tl() + box.br()) / 2.0F; }

cv::Rect2f box_around(const cv::Point2f& centre, const cv::Size2f& size) {
  return {centre.x - size.width / 2.0F, centre.y - size.height / 2.0F, size.width, size.height};
}

/// Intersection over union of where a thing should be and where one is seen; a little more for what
/// is seen inside or close by, as the rest of it may be covered.
double overlap_of_boxes(const cv::Rect2f& expected, const cv::Rect2f& seen, double doubt) {
  if (expected.empty() || seen.empty()) return 0.0;
  const double common = (expected & seen).area();
  const double all = expected.area() + seen.area() - common;
  const cv::Rect2f around =
      box_around(centre_of(expected), expected.size() * static_cast<float>(1.0 + doubt));
  return std::max(common / all, kPartWeight * (around & seen).area() / seen.area());
}

/// `centre`, moved no farther than it takes for a box of `size` to hold `part`.
cv::Point2f moved_to_hold(const cv::Rect2f& part, cv::Point2f centre, const cv::Size2f& size) {
  const cv::Rect2f box = box_around(centre, size);
  centre.x += std::min(part.x - box.x, 0.0F) + std::max(part.br().x - box.br().x, 0.0F);
  centre.y += std::min(part.y - box.y, 0.0F) + std::max(part.br().y - box.br().y, 0.0F);
  return centre;
}

}  // namespace

cv::Point2f InstanceTracker::Track::motion_until(std::int64_t later_ns) const {
  return velocity * to_seconds(later_ns - stamp_ns);
}

cv::Rect2f InstanceTracker::Track::box_at(std::int64_t later_ns) const {
  return box_around(centre + motion_until(later_ns), size);
}

void InstanceTracker::follow(InstanceSegmentation& seen) {
  forget(seen);
  const Seen sampled = sample(seen);
  std::vector<std::optional<std::size_t>> track_of(seen.instances.size());
  std::vector<bool> is_taken(tracks_.size(), false);
  for (const Pair& pair : likely_pairs(sampled)) {
    if (is_taken[pair.track] || track_of[pair.instance]) continue;
    is_taken[pair.track] = true;
    track_of[pair.instance] = pair.track;
  }
  for (std::size_t i = 0; i < seen.instances.size(); ++i) {
    const std::size_t track = track_of[i] ? *track_of[i] : begin(seen.instances[i], seen.stamp_ns);
    update(tracks_[track], sampled, i);
    seen.instances[i].track_id = tracks_[track].id;
  }
}

/// Drops what is too long ago, or of another stream of images.
void InstanceTracker::forget(const InstanceSegmentation& mask) {
  if (mask.stamp_ns < last_stamp_ns_ || mask.labels.size() != size_) tracks_.clear();
  last_stamp_ns_ = mask.stamp_ns;
  size_ = mask.labels.size();
  std::erase_if(tracks_,
                [&](const Track& track) { return mask.stamp_ns - track.stamp_ns > kMemoryNs; });
}

InstanceTracker::Seen InstanceTracker::sample(const InstanceSegmentation& mask) {
  Seen seen{.mask = mask, .labels = {}, .samples = {}};
  seen.samples.resize(mask.instances.size());
  seen.labels.create((mask.labels.rows + kStep - 1) / kStep, (mask.labels.cols + kStep - 1) / kStep,
                     CV_8UC1);
  for (int y = 0; y < seen.labels.rows; ++y) {
    const auto* labels = mask.labels.ptr<std::uint8_t>(y * kStep);
    auto* sampled = seen.labels.ptr<std::uint8_t>(y);
    for (int x = 0; x < seen.labels.cols; ++x) {
      sampled[x] = labels[x * kStep];
      if (sampled[x] != 0) seen.samples.at(sampled[x] - 1U).emplace_back(x, y);
    }
  }
  return seen;
}

/// The most alike first.
std::vector<InstanceTracker::Pair> InstanceTracker::likely_pairs(const Seen& seen) const {
  std::vector<Pair> pairs;
  for (std::size_t track = 0; track < tracks_.size(); ++track) add_pairs(track, seen, pairs);
  std::stable_sort(pairs.begin(), pairs.end(),
                   [](const Pair& a, const Pair& b) { return a.likeness > b.likeness; });
  return pairs;
}

void InstanceTracker::add_pairs(std::size_t index,
                                const Seen& seen,
                                std::vector<Pair>& pairs) const {
  const Track& track = tracks_[index];
  const cv::Point2f motion = track.motion_until(seen.mask.stamp_ns);
  const cv::Point shift(static_cast<int>(std::lround(motion.x / kStep)),
                        static_cast<int>(std::lround(motion.y / kStep)));
  const cv::Rect inside(cv::Point(0, 0), seen.labels.size());
  std::array<std::size_t, 256> common{};  // samples of the track that now have this label
  for (const cv::Point& sample : track.samples) {
    const cv::Point moved = sample + shift;
    if (moved.inside(inside)) ++common.at(seen.labels.at<std::uint8_t>(moved));
  }
  const cv::Rect2f box = track.box_at(seen.mask.stamp_ns);
  const double doubt =
      kDoubt + kMoreDoubtPerSecond * to_seconds(seen.mask.stamp_ns - track.whole_ns);
  for (std::size_t i = 0; i < seen.samples.size(); ++i) {
    if (seen.mask.instances[i].class_name != track.class_name) continue;
    const std::size_t both = common.at(i + 1);
    const std::size_t either = track.samples.size() + seen.samples[i].size() - both;
    const double of_masks =
        either > 0 ? static_cast<double>(both) / static_cast<double>(either) : 0;
    const double of_boxes = overlap_of_boxes(box, seen.mask.instances[i].box, doubt);
    // Where boxes of two people cover each other, their masks do not; what comes out from behind
    // another shows another part of itself than before, but its box is where it should be.
    if (std::max(of_masks, of_boxes) < kLeastOverlap) continue;
    pairs.push_back({.likeness = of_masks + of_boxes, .track = index, .instance = i});
  }
}

std::size_t InstanceTracker::begin(const Instance& instance, std::int64_t stamp_ns) {
  Track& track = tracks_.emplace_back();
  track.id = next_id_++;
  if (next_id_ == 0) next_id_ = 1;
  track.class_name = instance.class_name;
  track.centre = centre_of(instance.box);
  track.size = instance.box.size();
  track.stamp_ns = stamp_ns;
  track.whole_ns = stamp_ns;
  return tracks_.size() - 1;
}

void InstanceTracker::update(Track& track, const Seen& seen, std::size_t instance) {
  const cv::Rect2f& box = seen.mask.instances[instance].box;
  const std::int64_t stamp_ns = seen.mask.stamp_ns;
  const double seconds = to_seconds(stamp_ns - track.stamp_ns);
  const bool is_part =
      box.width < kWholeShare * track.size.width || box.height < kWholeShare * track.size.height;
  if (is_part && stamp_ns - track.whole_ns <= kLongestPartNs) {
    // The centre of what shows goes other ways than the thing: it is carried on instead.
    track.centre = moved_to_hold(box, track.centre + track.motion_until(stamp_ns), track.size);
  } else {
    if (seconds > 0.0) {
      const cv::Point2f measured = (centre_of(box) - track.centre) / seconds;
      const double weight =
          std::max(1.0 / track.times_seen, 1.0 - std::exp(-seconds / kVelocityMemory));
      track.velocity += (measured - track.velocity) * weight;
    }
    track.centre = centre_of(box);
    track.size = box.size();
    track.whole_ns = stamp_ns;
  }
  track.samples = seen.samples[instance];
  track.stamp_ns = stamp_ns;
  ++track.times_seen;
}

}  // namespace tsg
