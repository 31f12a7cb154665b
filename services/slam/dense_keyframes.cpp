#include "services/slam/dense_keyframes.hpp"

#include <algorithm>
#include <utility>

namespace tsg {

std::optional<DenseKeyframe> DenseKeyframes::add_frame(const RgbdFrame& frame,
                                                       const KeyframePlace& place,
                                                       bool is_keyframe,
                                                       const InstanceSegmentation* own_mask) {
  const bool is_wanted = is_keyframe || !waiting_.empty();
  if (!is_wanted) return std::nullopt;
  if (own_mask != nullptr || !expect_masks_) {
    for (Waiting& older : waiting_) spare_.push_back(std::move(older.frame));
    waiting_.clear();
    auto mask = own_mask != nullptr ? std::optional(*own_mask) : std::nullopt;
    return DenseKeyframe{frame, place, std::move(mask)};
  }
  keep(frame, place);
  if (frame.stamp_ns - waiting_.front().frame.stamp_ns < patience_ns_) return std::nullopt;
  return flush();
}

std::optional<DenseKeyframe> DenseKeyframes::add_mask(const InstanceSegmentation& mask) {
  const auto found = std::ranges::find_if(
      waiting_, [&](const Waiting& waiting) { return waiting.frame.seq == mask.frame_seq; });
  if (found == waiting_.end()) return std::nullopt;
  return release(std::move(*found), mask);
}

std::optional<DenseKeyframe> DenseKeyframes::flush() {
  if (waiting_.empty()) return std::nullopt;
  ++without_mask_;
  return release(std::move(waiting_.front()), std::nullopt);
}

void DenseKeyframes::keep(const RgbdFrame& frame, const KeyframePlace& place) {
  Waiting copy{frame, place};
  copy.frame.colour = cv::Mat();
  copy.frame.depth = cv::Mat();
  if (!spare_.empty()) {
    copy.frame.colour = std::move(spare_.back().colour);
    copy.frame.depth = std::move(spare_.back().depth);
    spare_.pop_back();
  }
  frame.colour.copyTo(copy.frame.colour);
  frame.depth.copyTo(copy.frame.depth);
  waiting_.push_back(std::move(copy));
}

DenseKeyframe DenseKeyframes::release(Waiting waiting,
                                      std::optional<InstanceSegmentation> segmentation) {
  if (released_) spare_.push_back(std::move(released_->frame));
  released_ = std::move(waiting);
  for (Waiting& other : waiting_) {
    if (!other.frame.colour.empty()) spare_.push_back(std::move(other.frame));
  }
  waiting_.clear();
  return {released_->frame, released_->place, std::move(segmentation)};
}

}  // namespace tsg
