#pragma once

#include <chrono>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "services/tsgctl/simulate/sequence_writer.hpp"
#include "tests/support/run_program.hpp"
#include "tests/support/temp_folder.hpp"

namespace tsg::test {

/// Generous: machines that run tests are slow, or do something else beside.
inline constexpr std::chrono::minutes kRunTimeout{5};

/// `tsgctl run` into a folder of its own.
class TsgctlRun {
 public:
  explicit TsgctlRun(const std::filesystem::path& input, std::vector<std::string> options = {}) {
    arguments_ = {"run", "--input", input.string(), "--out", out().string()};
    arguments_.insert(arguments_.end(), options.begin(), options.end());
  }

  [[nodiscard]] std::filesystem::path out() const { return folder_ / "out"; }

  /// Runs to the end.
  ProgramResult run() { return start().wait(kRunTimeout); }
  [[nodiscard]] RunningProgram start() const { return {TSG_BIN_DIR "/tsgctl", arguments_}; }

  /// OUT/report.json; null where it is absent or damaged.
  [[nodiscard]] nlohmann::json report() const {
    return nlohmann::json::parse(test::content_of(out() / "report.json"), nullptr,
                                 /*allow_exceptions=*/false);
  }

 private:
  test::TempFolder folder_;
  std::vector<std::string> arguments_;
};

/// A short sequence of the simulated room, written once for all tests of a program.
inline const std::filesystem::path& simulated_room() {
  static const test::TempFolder folder;
  static const std::filesystem::path path = [] {
    const std::filesystem::path room = folder / "room";
    write_simulated_sequence(room, {.frames = 40, .width = 640, .height = 480});
    return room;
  }();
  return path;
}

}  // namespace tsg::test
