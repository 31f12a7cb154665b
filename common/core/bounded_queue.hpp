#pragma once

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <mutex>
#include <optional>
#include <stop_token>
#include <utility>

namespace tsg {

enum class WhenFull {
  kDropOldest,  ///< the newest matters: images
  kBlock,       ///< nothing may be lost: keyframes
};

/// Hands values from any number of threads to any number of threads, at most `capacity` waiting.
template <typename T>
class BoundedQueue {
 public:
  BoundedQueue(std::size_t capacity, WhenFull when_full)
      : capacity_(capacity), when_full_(when_full) {}

  /// Adds a value. With kBlock waits for room; false if `stop` came first (the value is not added).
  bool push(T value, const std::stop_token& stop = {}) {
    std::unique_lock lock(mutex_);
    if (when_full_ == WhenFull::kBlock) {
      if (!changed_.wait(lock, stop, [this] { return values_.size() < capacity_; })) return false;
    } else if (values_.size() >= capacity_) {
      values_.pop_front();
      ++dropped_;
    }
    values_.push_back(std::move(value));
    changed_.notify_all();
    return true;
  }

  /// Waits for a value; what is queued is still handed out after `stop`, then nothing.
  std::optional<T> pop(const std::stop_token& stop) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, stop, [this] { return !values_.empty(); });
    return take_front();
  }

  std::optional<T> try_pop() {
    const std::unique_lock lock(mutex_);
    return take_front();
  }

  [[nodiscard]] std::size_t size() const {
    const std::unique_lock lock(mutex_);
    return values_.size();
  }

  /// Values lost to kDropOldest since the start.
  [[nodiscard]] std::uint64_t dropped() const {
    const std::unique_lock lock(mutex_);
    return dropped_;
  }

 private:
  std::optional<T> take_front() {
    if (values_.empty()) return std::nullopt;
    std::optional<T> value(std::move(values_.front()));
    values_.pop_front();
    changed_.notify_all();
    return value;
  }

  const std::size_t capacity_;
  const WhenFull when_full_;
  mutable std::mutex mutex_;  // guards values_ and dropped_
  std::condition_variable_any changed_;
  std::deque<T> values_;
  std::uint64_t dropped_ = 0;
};

}  // namespace tsg
