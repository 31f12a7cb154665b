#pragma once

#include <sys/types.h>

#include <chrono>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "common/core/error.hpp"

namespace tsg {

/// How to start a program.
struct ChildCommand {
  std::string program;                                  ///< a path, or a name to be found in PATH
  std::vector<std::string> arguments = {};              ///< without the program itself
  std::map<std::string, std::string> environment = {};  ///< added to ours
  /// Where its stdout and stderr go (appended); empty: where ours go.
  std::filesystem::path output_file = {};
};

/// How a child ended and what it used.
struct ChildExit {
  int exit_code = 0;  ///< valid where signal is 0
  int signal = 0;     ///< that killed it
  double cpu_seconds = 0.0;
  double peak_rss_mib = 0.0;

  [[nodiscard]] bool is_success() const { return exit_code == 0 && signal == 0; }
  /// "exit code 66", "killed by signal 9 (SIGKILL)".
  [[nodiscard]] std::string describe() const;
};

/// A running program in a process group of its own. Dies with the thread that started it
/// (PR_SET_PDEATHSIG), and with this object. Not thread-safe: one owner.
class ChildProcess {
 public:
  /// kUnavailable where the program cannot be started; the message names it.
  static Expected<ChildProcess> spawn(const ChildCommand& command);

  ChildProcess(ChildProcess&& other) noexcept;
  ChildProcess& operator=(ChildProcess&& other) noexcept;
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;
  /// SIGTERM to the group if it still runs, and SIGKILL after two seconds. Not at once: who is
  /// killed while it holds a lock in shared memory leaves it locked, for RouDi as well.
  ~ChildProcess();

  [[nodiscard]] pid_t pid() const { return pid_; }
  /// How it ended, if it has; does not wait.
  [[nodiscard]] const std::optional<ChildExit>& poll();
  /// How it ended; nothing where it still runs after `timeout`.
  [[nodiscard]] const std::optional<ChildExit>& wait(std::chrono::milliseconds timeout);
  /// Sends a signal to its process group; does nothing once it has ended.
  void signal(int number);
  /// SIGTERM, and SIGKILL after `grace`.
  ChildExit terminate(std::chrono::milliseconds grace);

 private:
  explicit ChildProcess(pid_t pid, int pid_fd) : pid_(pid), pid_fd_(pid_fd) {}
  void reap(int options);
  void release() noexcept;

  pid_t pid_ = -1;
  int pid_fd_ = -1;  // becomes readable when the process ends
  std::optional<ChildExit> exit_;
};

}  // namespace tsg
