#pragma once

#include <chrono>
#include <string>

namespace tsg {

/// What to do while a topic is silent: say so once, give up after the user's timeout.
class TopicWait {
 public:
  /// How long one look for a message may take.
  static constexpr std::chrono::milliseconds kStep{200};

  /// `timeout_s` 0 waits for ever.
  TopicWait(std::string topic, double timeout_s);

  void something_came() { last_ = Clock::now(); }
  /// Throws FatalError (kTimeout) once the timeout has passed.
  void nothing_came(int publishers);

 private:
  using Clock = std::chrono::steady_clock;

  std::string topic_;
  std::chrono::duration<double> timeout_;
  Clock::time_point last_ = Clock::now();
  bool has_said_so_ = false;
};

}  // namespace tsg
