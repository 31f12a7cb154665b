#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>

namespace tsg {

/// A frame that was sent to another host.
struct SentFrame {
  std::uint64_t seq = 0;
  std::int64_t stamp_ns = 0;
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::int64_t published_ns = 0;  ///< by the camera; monotonic, as all below
  std::int64_t taken_ns = 0;      ///< when it was taken up
  std::int64_t sent_ns = 0;
  std::int64_t compressing_ns = 0;
};

/// Which frames wait for the answer of another host. So many at most: what is sent beyond that
/// would only queue up somewhere and be late. One that was not answered for a while leaves its
/// place, but its answer is taken if it comes before that of a later frame. Time is the caller's.
class FramesUnderWay {
 public:
  /// `most` >= 1 at a time; after `patience_ns` without an answer a frame leaves its place.
  FramesUnderWay(std::size_t most, std::int64_t patience_ns)
      : most_(most), patience_ns_(patience_ns) {}

  [[nodiscard]] bool has_room(std::int64_t now_ns) const { return awaited(now_ns) < most_; }

  /// Returns how many frames before it nobody waits for any more.
  std::size_t add(const SentFrame& frame);

  /// That frame could not be sent after all.
  void remove(std::uint64_t seq, std::int64_t sent_ns);

  struct Answered {
    SentFrame frame;
    std::size_t overtaken = 0;  ///< frames before it, whose answers nobody waits for any more
  };
  /// The frame with that seq and time of sending, which waits no longer; none where it was answered
  /// or overtaken, or was never sent by us.
  [[nodiscard]] std::optional<Answered> take(std::uint64_t seq, std::int64_t sent_ns);

  /// Frames in their places.
  [[nodiscard]] std::size_t awaited(std::int64_t now_ns) const;

  /// Whether a frame has waited in vain and no answer has come since it was sent.
  [[nodiscard]] bool is_silent(std::int64_t now_ns) const;

 private:
  [[nodiscard]] std::deque<SentFrame>::iterator find(std::uint64_t seq, std::int64_t sent_ns);

  std::size_t most_;
  std::int64_t patience_ns_;
  std::deque<SentFrame> frames_;  ///< in the order of sending; few
};

}  // namespace tsg
