#pragma once

#include <chrono>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

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
  [[nodiscard]] ProgramResult run() const { return start().wait(kRunTimeout); }
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

/// What stands between the first "{" and the end: progress goes to stderr, which is in the output.
inline nlohmann::json json_of(const ProgramResult& result) {
  return nlohmann::json::parse(result.output.substr(result.output.find("\n{\n")));
}

/// The beginning of a shipped scene, in a folder that is not there yet.
inline void simulate(const std::filesystem::path& folder,
                     const std::string& scene,
                     const std::vector<std::string>& options) {
  std::vector<std::string> arguments{"simulate", scene, "--out", folder.string()};
  arguments.insert(arguments.end(), options.begin(), options.end());
  const ProgramResult result = RunningProgram(TSG_BIN_DIR "/tsgctl", arguments).wait(kRunTimeout);
  if (result.end.exit_code != 0) throw std::runtime_error(result.output);
}

/// A short sequence of a simulated office, made once for all tests of a program.
inline const std::filesystem::path& simulated_room() {
  static const test::TempFolder kFolder;
  static const std::filesystem::path kPath = [] {
    simulate(kFolder / "room", "demo", {"--frames", "40"});
    return kFolder / "room";
  }();
  return kPath;
}

}  // namespace tsg::test
