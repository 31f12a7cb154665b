#include "services/slam/lib/dynamic/past_frames.hpp"

#include <algorithm>
#include <ranges>
#include <utility>

namespace tsg {
namespace {

constexpr std::int64_t kSpanNs = 2'600'000'000;
constexpr std::size_t kDenseFrames = 32;  // masks come late by as much as half a second
constexpr std::size_t kMaxFrames = 128;   // whatever the rate of the camera

}  // namespace

void PastFrames::add(PastFrame frame) {
  // Stamps that go back are those of another recording: nothing before can be compared.
  if (!frames_.empty() && frame.stamp_ns <= now().stamp_ns) frames_.clear();
  frames_.push_back(std::move(frame));
  while (frames_.size() > kMaxFrames || now().stamp_ns - frames_.front().stamp_ns > kSpanNs) {
    frames_.pop_front();
  }
  if (frames_.size() <= kDenseFrames) return;
  // Far back every other frame will do, and its features are not asked for again.
  PastFrame& leaving = frames_[frames_.size() - 1 - kDenseFrames];
  leaving.features.reset();
  if (leaving.seq % 4 != 0) {
    frames_.erase(frames_.end() - 1 - static_cast<std::ptrdiff_t>(kDenseFrames));
  }
}

PastFrame* PastFrames::find(std::uint64_t seq) {
  const auto frame = std::ranges::find(frames_, seq, &PastFrame::seq);
  return frame == frames_.end() ? nullptr : &*frame;
}

const PastFrame* PastFrames::find(std::uint64_t seq) const {
  const auto frame = std::ranges::find(frames_, seq, &PastFrame::seq);
  return frame == frames_.end() ? nullptr : &*frame;
}

const PastFrame* PastFrames::before(std::int64_t age_ns) const {
  for (const PastFrame& frame : frames_ | std::views::reverse) {
    const std::int64_t age = now().stamp_ns - frame.stamp_ns;
    if (age >= 2 * age_ns) return nullptr;
    if (age >= age_ns && frame.T_world_camera) return &frame;
  }
  return nullptr;
}

void PastFrames::move_world(const SE3& T_moved_world) {
  for (PastFrame& frame : frames_) {
    if (frame.T_world_camera) frame.T_world_camera = T_moved_world * *frame.T_world_camera;
  }
}

void PastFrames::forget_poses() {
  for (PastFrame& frame : frames_) frame.T_world_camera.reset();
}

}  // namespace tsg
