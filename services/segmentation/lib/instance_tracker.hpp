#pragma once

#include <cstddef>
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <opencv2/core/types.hpp>
#include <optional>
#include <string>
#include <vector>

#include "common/rgbd/instances.hpp"

namespace tsg {

/// Recognises the instances of one mask in the next ones, so that each thing keeps its number: by
/// how much boxes and masks overlap once the thing has been moved on with its velocity in the
/// image. A thing that is covered or missed comes back under its number within kMemoryNs; later it
/// is a new one. Things of different classes are never the same.
class InstanceTracker {
 public:
  /// Half a second at 2 Hz must not end a track; beyond two seconds a guess is as good as any.
  static constexpr std::int64_t kMemoryNs = 1'500'000'000;

  /// Sets track_id of each instance of `seen`, none of them 0. Masks come in the order of their
  /// stamps: one that is older than the last, or of another size, begins anew.
  void follow(InstanceSegmentation& seen);

 private:
  /// A thing as it was last seen.
  struct Track {
    std::uint32_t id = 0;
    std::string class_name;
    cv::Point2f centre;    ///< pixels, of the whole thing, even where part of it is covered
    cv::Size2f size;       ///< pixels, the same
    cv::Point2f velocity;  ///< of the centre, pixels per second
    std::int64_t stamp_ns = 0;
    std::int64_t whole_ns = 0;  ///< when all of it was last seen
    int times_seen = 0;
    std::vector<cv::Point> samples;  ///< of the sampled label image

    [[nodiscard]] cv::Point2f motion_until(std::int64_t later_ns) const;
    [[nodiscard]] cv::Rect2f box_at(std::int64_t later_ns) const;
  };
  /// A mask with every kStep-th row and column of its labels.
  struct Seen {
    const InstanceSegmentation& mask;
    cv::Mat labels;
    std::vector<std::vector<cv::Point>> samples;  ///< of each instance
  };
  struct Pair {
    double likeness = 0.0;
    std::size_t track = 0;
    std::size_t instance = 0;
  };

  [[nodiscard]] static Seen sample(const InstanceSegmentation& mask);
  void forget(const InstanceSegmentation& mask);
  [[nodiscard]] std::vector<Pair> likely_pairs(const Seen& seen) const;
  void add_pairs(std::size_t track, const Seen& seen, std::vector<Pair>& pairs) const;
  static void update(Track& track, const Seen& seen, std::size_t instance);
  std::size_t begin(const Instance& instance, std::int64_t stamp_ns);

  std::vector<Track> tracks_;
  std::uint32_t next_id_ = 1;
  std::int64_t last_stamp_ns_ = 0;
  cv::Size size_;
};

}  // namespace tsg
