#pragma once

#include <memory>
#include <mutex>
#include <utility>

namespace tsg {

/// The newest of a series of immutable values, handed from the thread that makes them to those that
/// read them. A reader keeps the value it got for as long as it likes.
///
/// Not std::atomic<std::shared_ptr>: load() of libstdc++ 12 gives back the pointer's lock by a
/// relaxed store, which does not order its read before the next write: a data race.
template <typename T>
class SharedValue {
 public:
  explicit SharedValue(std::shared_ptr<const T> value = nullptr) : value_(std::move(value)) {}

  [[nodiscard]] std::shared_ptr<const T> load() const {
    const std::scoped_lock lock(mutex_);
    return value_;
  }

  void store(std::shared_ptr<const T> value) {
    const std::scoped_lock lock(mutex_);
    value_.swap(value);
  }  // the value before, if nobody reads it, is destroyed once the lock is released

 private:
  mutable std::mutex mutex_;
  std::shared_ptr<const T> value_;
};

}  // namespace tsg
