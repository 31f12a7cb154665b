#include "common/app/child_process.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <system_error>
#include <utility>

#include "common/app/stop_on_signal.hpp"

namespace tsg {
namespace {

constexpr double kKibPerMib = 1024.0;
constexpr std::chrono::milliseconds kGrace{2000};  // services end within it

double to_seconds(const timeval& time) {
  return static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_usec) * 1e-6;
}

std::vector<std::string> merged_environment(const std::map<std::string, std::string>& added) {
  std::vector<std::string> result;
  for (char** entry = environ; *entry != nullptr; ++entry) {
    const std::string text(*entry);
    if (!added.contains(text.substr(0, text.find('=')))) result.push_back(text);
  }
  for (const auto& [name, value] : added) result.push_back(name + "=" + value);
  return result;
}

/// The null-terminated array that exec wants; points into `texts`.
std::vector<char*> to_pointers(std::vector<std::string>& texts) {
  std::vector<char*> pointers;
  pointers.reserve(texts.size() + 1);
  for (std::string& text : texts) pointers.push_back(text.data());
  pointers.push_back(nullptr);
  return pointers;
}

/// What the child does between fork and exec: async-signal-safe calls only. Reports errno through
/// `error_pipe`, which a successful exec closes.
struct ChildSetup {
  char* const* arguments;
  char* const* environment;
  int output_fd;
  int error_pipe;
  pid_t parent;

  [[noreturn]] void run() const {
    setpgid(0, 0);
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() != parent) _exit(1);  // the parent died before it could be watched
    unblock_stop_signals();
    if (output_fd >= 0) {
      dup2(output_fd, STDOUT_FILENO);
      dup2(output_fd, STDERR_FILENO);
    }
    execvpe(arguments[0], arguments, environment);
    const int error = errno;
    [[maybe_unused]] const auto written = write(error_pipe, &error, sizeof(error));
    _exit(1);
  }
};

Expected<int> open_output(const std::filesystem::path& path) {
  if (path.empty()) return -1;
  constexpr mode_t kMode = 0644;
  const int fd = open(path.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, kMode);
  if (fd >= 0) return fd;
  return make_error(ExitCode::kCannotWrite,
                    path.string() + ": cannot be opened for writing: " + errno_text());
}

}  // namespace

std::string ChildExit::describe() const {
  if (signal == 0) return "exit code " + std::to_string(exit_code);
  return "killed by signal " + std::to_string(signal) + " (SIG" + sigabbrev_np(signal) + ")";
}

Expected<ChildProcess> ChildProcess::spawn(const ChildCommand& command) {
  const Expected<int> output_fd = open_output(command.output_file);
  if (!output_fd) return tl::unexpected(output_fd.error());

  std::vector<std::string> argument_texts = {command.program};
  argument_texts.insert(argument_texts.end(), command.arguments.begin(), command.arguments.end());
  std::vector<std::string> environment_texts = merged_environment(command.environment);
  const std::vector<char*> arguments = to_pointers(argument_texts);
  const std::vector<char*> environment = to_pointers(environment_texts);
  std::array<int, 2> error_pipe{};
  if (pipe2(error_pipe.data(), O_CLOEXEC) != 0) {
    return make_error(ExitCode::kFailure, std::string("pipe2: ") + errno_text());
  }
  const ChildSetup setup{.arguments = arguments.data(),
                         .environment = environment.data(),
                         .output_fd = *output_fd,
                         .error_pipe = error_pipe[1],
                         .parent = getpid()};
  const pid_t pid = fork();
  if (pid == 0) setup.run();
  close(error_pipe[1]);
  if (*output_fd >= 0) close(*output_fd);
  int error = pid < 0 ? errno : 0;
  if (pid > 0 && read(error_pipe[0], &error, sizeof(error)) > 0) waitpid(pid, nullptr, 0);
  close(error_pipe[0]);
  if (error != 0) {
    return make_error(ExitCode::kUnavailable, command.program + ": cannot be started: " +
                                                  std::generic_category().message(error));
  }
  return ChildProcess(pid, static_cast<int>(syscall(SYS_pidfd_open, pid, 0)));
}

ChildProcess::ChildProcess(ChildProcess&& other) noexcept
    : pid_(std::exchange(other.pid_, -1)),
      pid_fd_(std::exchange(other.pid_fd_, -1)),
      exit_(std::exchange(other.exit_, std::nullopt)) {}

ChildProcess& ChildProcess::operator=(ChildProcess&& other) noexcept {
  if (this == &other) return *this;
  release();
  pid_ = std::exchange(other.pid_, -1);
  pid_fd_ = std::exchange(other.pid_fd_, -1);
  exit_ = std::exchange(other.exit_, std::nullopt);
  return *this;
}

ChildProcess::~ChildProcess() { release(); }

void ChildProcess::release() noexcept {
  if (pid_ > 0 && !exit_) terminate(kGrace);
  if (pid_fd_ >= 0) close(pid_fd_);
  pid_ = -1;
  pid_fd_ = -1;
}

void ChildProcess::reap(int options) {
  if (exit_ || pid_ <= 0) return;
  int status = 0;
  rusage usage{};
  if (wait4(pid_, &status, options, &usage) != pid_) return;
  exit_ = ChildExit{.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 0,
                    .signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0,
                    .cpu_seconds = to_seconds(usage.ru_utime) + to_seconds(usage.ru_stime),
                    .peak_rss_mib = static_cast<double>(usage.ru_maxrss) / kKibPerMib};
}

const std::optional<ChildExit>& ChildProcess::poll() {
  reap(WNOHANG);
  return exit_;
}

const std::optional<ChildExit>& ChildProcess::wait(std::chrono::milliseconds timeout) {
  if (exit_) return exit_;
  pollfd ended{.fd = pid_fd_, .events = POLLIN, .revents = 0};
  ::poll(&ended, 1, static_cast<int>(timeout.count()));
  return poll();
}

void ChildProcess::signal(int number) {
  if (pid_ > 0 && !exit_) kill(-pid_, number);
}

ChildExit ChildProcess::terminate(std::chrono::milliseconds grace) {
  signal(SIGTERM);
  if (!wait(grace)) {
    signal(SIGKILL);
    reap(0);
  }
  return exit_.value_or(ChildExit{});
}

}  // namespace tsg
