#include "services/tsgctl/run/supervisor.hpp"

#include <algorithm>
#include <csignal>
#include <utility>

#include "services/tsgctl/run/log_tail.hpp"

namespace tsg {
namespace {

constexpr std::chrono::milliseconds kAliveCheckPeriod{50};

}  // namespace

ExitCode exit_code_after(const ChildExit& end) {
  const bool names_failure = end.signal == 0 &&
                             end.exit_code >= static_cast<int>(ExitCode::kUsage) &&
                             end.exit_code <= static_cast<int>(ExitCode::kConfig) &&
                             end.exit_code != static_cast<int>(ExitCode::kInternal);
  return names_failure ? static_cast<ExitCode>(end.exit_code) : ExitCode::kServiceDied;
}

void Supervisor::start(const ProcessPlan& plan) {
  NotifySocket notify(plan.service);
  ChildCommand command;
  command.program = plan.executable.string();
  command.arguments = plan.arguments;
  command.environment = {{"NOTIFY_SOCKET", notify.address()}};
  command.output_file = log_of(plan.service);
  processes_.push_back(
      {plan.service, std::move(notify), value_or_throw(ChildProcess::spawn(command))});
}

bool Supervisor::wait_ready(const std::string& service,
                            std::chrono::milliseconds timeout,
                            const std::stop_token& stop) {
  Process& process = *find(service);
  const auto deadline = std::chrono::steady_clock::now() + timeout;
  while (!process.notify.wait_ready(kAliveCheckPeriod)) {
    if (stop.stop_requested()) return false;
    check_alive("");
    if (std::chrono::steady_clock::now() < deadline) continue;
    throw FatalError(
        ExitCode::kTimeout,
        service + " was not ready after " +
            std::to_string(std::chrono::duration_cast<std::chrono::seconds>(timeout).count()) +
            " s; its log, " + log_of(service).string() + ", ends with\n" +
            log_tail(log_of(service), kLogLinesShown));
  }
  return true;
}

void Supervisor::check_alive(const std::string& may_finish) {
  for (Process& process : processes_) {
    const std::optional<ChildExit>& end = process.child.poll();
    if (!end) continue;
    if (process.service == may_finish && end->is_success()) continue;
    report_death(process, *end);
  }
}

void Supervisor::report_death(const Process& process, const ChildExit& end) const {
  const std::filesystem::path log = log_of(process.service);
  throw FatalError(exit_code_after(end),
                   process.service + " ended unexpectedly: " + end.describe() + "; its log, " +
                       log.string() + ", ends with\n" + log_tail(log, kLogLinesShown));
}

bool Supervisor::has_finished(const std::string& service) {
  Process* process = find(service);
  return process != nullptr && process->child.poll() && process->child.poll()->is_success();
}

bool Supervisor::is_running(const std::string& service) {
  Process* process = find(service);
  return process != nullptr && !process->child.poll();
}

void Supervisor::stop_all(const std::string& first, std::chrono::milliseconds budget) {
  processes_.sort([&](const Process& a, const Process& b) {
    return a.service == first && b.service != first;  // stable: the others keep their order
  });
  const auto deadline = std::chrono::steady_clock::now() + budget;
  // A head start lets what a process has sent arrive before its reader goes.
  const std::chrono::milliseconds head_start = budget / 10;
  for (Process& process : processes_) {
    process.child.signal(SIGTERM);
    (void)process.child.wait(head_start);
  }
  for (Process& process : processes_) {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(
        deadline - std::chrono::steady_clock::now());
    process.child.terminate(std::max(left, std::chrono::milliseconds(0)));
  }
}

std::vector<ProcessUse> Supervisor::uses() {
  std::vector<ProcessUse> result;
  for (Process& process : processes_) {
    const std::optional<ChildExit>& end = process.child.poll();
    if (!end) continue;
    result.push_back({process.service, end->cpu_seconds, end->peak_rss_mib, end->describe()});
  }
  return result;
}

std::filesystem::path Supervisor::log_of(const std::string& service) const {
  return log_folder_ / (service + ".log");
}

Supervisor::Process* Supervisor::find(const std::string& service) {
  const auto found = std::find_if(processes_.begin(), processes_.end(),
                                  [&](const Process& p) { return p.service == service; });
  return found == processes_.end() ? nullptr : &*found;
}

}  // namespace tsg
