#pragma once

#include <chrono>
#include <filesystem>
#include <list>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "common/app/child_process.hpp"
#include "services/tsgctl/lib/run_plan.hpp"
#include "services/tsgctl/lib/run_report.hpp"
#include "services/tsgctl/run/notify_socket.hpp"

namespace tsg {

/// Runs the processes of a plan: starts them, sees whether they live, stops them. Their output
/// goes to LOGS/<service>.log. Owned by the main thread: children die with the thread that started
/// them. Whatever still runs when this object goes is killed.
class Supervisor {
 public:
  explicit Supervisor(std::filesystem::path log_folder) : log_folder_(std::move(log_folder)) {}

  /// Starts a process; returns at once. Throws FatalError (kUnavailable) naming the executable.
  void start(const ProcessPlan& plan);

  /// Waits until `service` says READY=1. Throws FatalError: as check_alive(), kTimeout after
  /// `timeout`; false on stop.
  bool wait_ready(const std::string& service,
                  std::chrono::milliseconds timeout,
                  const std::stop_token& stop);

  /// Throws FatalError where a process has ended that should not have, with the end of its log
  /// in the message. The code is the process's own where it names a known failure (64 to 78),
  /// else kServiceDied. The end of `may_finish` with exit code 0 is no failure.
  void check_alive(const std::string& may_finish);

  /// Whether `service` has ended by itself with exit code 0.
  [[nodiscard]] bool has_finished(const std::string& service);
  [[nodiscard]] bool is_running(const std::string& service);

  /// Stops the named process first, then the others in the order of their start; what has not ended
  /// by itself within `budget` is killed.
  void stop_all(const std::string& first, std::chrono::milliseconds budget);

  /// What each process used and how it ended; of those that have.
  [[nodiscard]] std::vector<ProcessUse> uses();
  [[nodiscard]] std::filesystem::path log_of(const std::string& service) const;

 private:
  struct Process {
    std::string service;
    NotifySocket notify;
    ChildProcess child;
  };

  Process* find(const std::string& service);
  [[noreturn]] void report_death(const Process& process, const ChildExit& end) const;

  std::filesystem::path log_folder_;
  std::list<Process> processes_;
};

/// The code to end with when a service has ended like this: its own where it names a known
/// failure, else kServiceDied.
[[nodiscard]] ExitCode exit_code_after(const ChildExit& end);

}  // namespace tsg
