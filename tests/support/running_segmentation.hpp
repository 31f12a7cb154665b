#pragma once

#include <chrono>
#include <string>
#include <utility>
#include <vector>

#include "common/app/child_process.hpp"
#include "tests/support/temp_folder.hpp"

namespace tsg::test {

/// A process of tsg-segmentation, with what it wrote.
class RunningSegmentation {
 public:
  /// Starts it with `--set OVERRIDE` for each of `overrides`.
  explicit RunningSegmentation(const std::vector<std::string>& overrides)
      : process_(value_or_throw(ChildProcess::spawn(command(overrides)))) {}

  /// Ends it properly: a client killed while it hands over a sample leaves iceoryx's lock of that
  /// queue taken, and whoever reads the queue next hangs.
  ~RunningSegmentation() { process_.terminate(std::chrono::seconds(5)); }
  RunningSegmentation(const RunningSegmentation&) = delete;
  RunningSegmentation& operator=(const RunningSegmentation&) = delete;
  RunningSegmentation(RunningSegmentation&&) = delete;
  RunningSegmentation& operator=(RunningSegmentation&&) = delete;

  /// Its exit code; -1 where it still runs after `timeout` or was killed.
  int exit_code(std::chrono::milliseconds timeout) {
    const auto& ended = process_.wait(timeout);
    return ended && ended->signal == 0 ? ended->exit_code : -1;
  }
  [[nodiscard]] std::string output() const { return content_of(folder_ / "output"); }
  ChildProcess& process() { return process_; }

 private:
  [[nodiscard]] ChildCommand command(const std::vector<std::string>& overrides) const {
    ChildCommand command{.program = TSG_BIN_DIR "/tsg-segmentation"};
    for (const auto& override_text : overrides) {
      command.arguments.insert(command.arguments.end(), {"--set", override_text});
    }
    command.output_file = folder_ / "output";
    return command;
  }

  TempFolder folder_;
  ChildProcess process_;
};

}  // namespace tsg::test
