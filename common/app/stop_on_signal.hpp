#pragma once

#include <atomic>
#include <stop_token>
#include <thread>

namespace tsg {

/// Turns SIGTERM and SIGINT into a stop request. Make it before any other thread: threads inherit
/// the blocked signals, so that only this one receives them.
class StopOnSignal {
 public:
  StopOnSignal();

  [[nodiscard]] std::stop_token token() const { return source_.get_token(); }
  /// The signal that asked to stop, 0 if none has.
  [[nodiscard]] int signal() const { return signal_; }

 private:
  void wait(const std::stop_token& end);

  std::stop_source source_;
  std::atomic<int> signal_ = 0;
  std::jthread waiter_;
};

/// Unblocks the signals that StopOnSignal blocks, in a child process before it runs its program.
void unblock_stop_signals();

}  // namespace tsg
