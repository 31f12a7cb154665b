#include "services/segmentation/lib/remote/frames_under_way.hpp"

#include <algorithm>

namespace tsg {

namespace {

constexpr std::size_t kMostRemembered = 64;  // a link that is away for long must not fill memory

}  // namespace

std::size_t FramesUnderWay::add(const SentFrame& frame) {
  frames_.push_back(frame);
  if (frames_.size() <= kMostRemembered) return 0;
  frames_.pop_front();
  return 1;
}

std::deque<SentFrame>::iterator FramesUnderWay::find(std::uint64_t seq, std::int64_t sent_ns) {
  return std::find_if(frames_.begin(), frames_.end(), [&](const SentFrame& frame) {
    return frame.seq == seq && frame.sent_ns == sent_ns;
  });
}

void FramesUnderWay::remove(std::uint64_t seq, std::int64_t sent_ns) {
  if (const auto found = find(seq, sent_ns); found != frames_.end()) frames_.erase(found);
}

std::optional<FramesUnderWay::Answered> FramesUnderWay::take(std::uint64_t seq,
                                                             std::int64_t sent_ns) {
  const auto found = find(seq, sent_ns);
  if (found == frames_.end()) return std::nullopt;
  const Answered answered{.frame = *found,
                          .overtaken = static_cast<std::size_t>(found - frames_.begin())};
  frames_.erase(frames_.begin(), found + 1);
  return answered;
}

std::size_t FramesUnderWay::awaited(std::int64_t now_ns) const {
  return static_cast<std::size_t>(
      std::count_if(frames_.begin(), frames_.end(),
                    [&](const SentFrame& frame) { return now_ns - frame.sent_ns < patience_ns_; }));
}

bool FramesUnderWay::is_silent(std::int64_t now_ns) const {
  // An answer takes all frames before its own away: whoever is first has not been overtaken.
  return !frames_.empty() && now_ns - frames_.front().sent_ns >= patience_ns_;
}

}  // namespace tsg
