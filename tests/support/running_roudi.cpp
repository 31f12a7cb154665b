#include "tests/support/running_roudi.hpp"

#include "common/bus/roudi.hpp"
#include "tests/support/wait.hpp"

namespace tsg::test {

using namespace std::chrono_literals;

RunningRoudi& RunningRoudi::instance() {
  static RunningRoudi roudi;
  return roudi;
}

RunningRoudi::RunningRoudi() {
  if (check_roudi()) return;
  // Not monitoring: a process that a busy machine keeps waiting for 1.5 s would get no sample ever
  // after.
  process_ = value_or_throw(
      ChildProcess::spawn({.program = "iox-roudi",
                           .arguments = {"--config-file", TSG_SOURCE_DIR "/config/roudi.toml",
                                         "--monitoring-mode", "off"},
                           .output_file = "/tmp/roudi.log"}));
  if (!eventually(10s, [this] { return check_roudi() || process_->poll(); }) || !check_roudi()) {
    throw FatalError(ExitCode::kUnavailable,
                     "iox-roudi does not start; see /tmp/roudi.log of the test's own host");
  }
}

std::optional<pid_t> RunningRoudi::pid() const {
  if (!process_) return std::nullopt;
  return process_->pid();
}

}  // namespace tsg::test
