#pragma once

#include <chrono>
#include <string>
#include <vector>

#include "common/app/child_process.hpp"
#include "tests/support/temp_folder.hpp"

namespace tsg::test {

/// A tsg-map-server of its own.
class MapServerProcess {
 public:
  explicit MapServerProcess(const std::vector<std::string>& arguments = {})
      : child_(value_or_throw(ChildProcess::spawn({.program = TSG_BIN_DIR "/tsg-map-server",
                                                   .arguments = arguments,
                                                   .output_file = scratch_ / "log"}))) {}

  [[nodiscard]] ChildProcess& child() { return child_; }
  [[nodiscard]] std::string log() const { return content_of(scratch_ / "log"); }
  /// Its exit code; -1 where it runs on or was killed.
  [[nodiscard]] int exit_code(std::chrono::milliseconds timeout = std::chrono::seconds(20)) {
    const auto& end = child_.wait(timeout);
    return end && end->signal == 0 ? end->exit_code : -1;
  }

 private:
  TempFolder scratch_;
  ChildProcess child_;
};

}  // namespace tsg::test
