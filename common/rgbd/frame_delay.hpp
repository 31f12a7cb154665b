#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <utility>

namespace tsg {

/// Holds back what belongs to a frame until so many frames later.
template <typename T>
class FrameDelay {
 public:
  /// `frames` >= 0; with 0 all is due at once.
  explicit FrameDelay(int frames) : frames_(static_cast<std::uint64_t>(frames)) {}

  /// Frames come in their order; one before the last means that the camera has started anew, and
  /// what is held back of its earlier frames is forgotten; returns how many these are.
  std::size_t put(std::uint64_t frame_seq, T value) {
    const bool is_anew = !held_.empty() && frame_seq < held_.back().first;
    const std::size_t forgotten = is_anew ? held_.size() : 0;
    if (is_anew) held_.clear();
    held_.emplace_back(frame_seq, std::move(value));
    return forgotten;
  }

  /// The oldest that is due now that frame `present_seq` has been taken in; none: no more.
  [[nodiscard]] std::optional<T> take_due(std::uint64_t present_seq) {
    if (held_.empty() || held_.front().first + frames_ > present_seq) return std::nullopt;
    std::optional<T> due = std::move(held_.front().second);
    held_.pop_front();
    return due;
  }

 private:
  std::uint64_t frames_;
  std::deque<std::pair<std::uint64_t, T>> held_;
};

}  // namespace tsg
