#pragma once

#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

#include "common/app/child_process.hpp"
#include "tests/support/temp_folder.hpp"

namespace tsg::test {

/// A tsg-camera of its own that replays a folder.
class CameraProcess {
 public:
  /// `settings` are "section.key=value".
  CameraProcess(const std::filesystem::path& folder, const std::vector<std::string>& settings)
      : child_(value_or_throw(ChildProcess::spawn(command(folder, settings)))) {}

  [[nodiscard]] ChildProcess& child() { return child_; }
  [[nodiscard]] std::string log() const { return content_of(scratch_ / "log"); }
  /// Its exit code; -1 where it runs on or was killed.
  [[nodiscard]] int exit_code(std::chrono::milliseconds timeout = std::chrono::seconds(20)) {
    const auto& end = child_.wait(timeout);
    return end && end->signal == 0 ? end->exit_code : -1;
  }

 private:
  [[nodiscard]] ChildCommand command(const std::filesystem::path& folder,
                                     const std::vector<std::string>& settings) const {
    std::vector<std::string> arguments{"--set", "camera.replay.folder=" + folder.string()};
    for (const std::string& setting : settings) {
      arguments.insert(arguments.end(), {"--set", setting});
    }
    return {.program = TSG_BIN_DIR "/tsg-camera",
            .arguments = arguments,
            .output_file = scratch_ / "log"};
  }

  TempFolder scratch_;
  ChildProcess child_;
};

}  // namespace tsg::test
