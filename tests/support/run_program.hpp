#pragma once

#include <chrono>
#include <string>
#include <vector>

#include "common/app/child_process.hpp"
#include "common/core/error.hpp"
#include "tests/support/temp_folder.hpp"

namespace tsg::test {

/// As ChildExit tells it.
inline int code(ExitCode exit_code) { return static_cast<int>(exit_code); }

/// What a program did.
struct ProgramResult {
  ChildExit end;
  std::string output;  ///< stdout and stderr, as they came
};

/// A program with its output in a file, for tests that look at both.
class RunningProgram {
 public:
  RunningProgram(const std::string& program, const std::vector<std::string>& arguments)
      : child_(value_or_throw(ChildProcess::spawn({.program = program,
                                                   .arguments = arguments,
                                                   .environment = {},
                                                   .output_file = folder_ / "output"}))) {}

  [[nodiscard]] ChildProcess& child() { return child_; }
  [[nodiscard]] std::string output() const { return test::content_of(folder_ / "output"); }

  /// Its end; killed, which the caller's check of the exit code shows, after `timeout`.
  ProgramResult wait(std::chrono::milliseconds timeout) {
    if (!child_.wait(timeout)) (void)child_.terminate(std::chrono::milliseconds(0));
    return {child_.poll().value_or(ChildExit{.exit_code = -1}), output()};
  }

 private:
  test::TempFolder folder_;
  ChildProcess child_;
};

/// Runs a program to its end.
inline ProgramResult run_program(const std::string& program,
                                 const std::vector<std::string>& arguments,
                                 std::chrono::milliseconds timeout = std::chrono::seconds(30)) {
  return RunningProgram(program, arguments).wait(timeout);
}

}  // namespace tsg::test
