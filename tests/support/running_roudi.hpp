#pragma once

#include <optional>

#include "common/app/child_process.hpp"

namespace tsg::test {

/// RouDi with the shipped configuration for the rest of this test process. One that runs already
/// is used and left alone. iceoryx ties a process to the RouDi it met first, so there is one for
/// all tests of a program, and it goes after everything else.
class RunningRoudi {
 public:
  /// Starts it at the first call; throws FatalError where it does not answer within 10 s.
  static RunningRoudi& instance();

  /// Process id of the RouDi that we started, if we did.
  [[nodiscard]] std::optional<pid_t> pid() const;

 private:
  RunningRoudi();

  std::optional<ChildProcess> process_;
};

}  // namespace tsg::test
