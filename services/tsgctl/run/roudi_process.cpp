#include "services/tsgctl/run/roudi_process.hpp"

#include <chrono>
#include <string>

#include "common/app/shipped_files.hpp"
#include "common/bus/roudi.hpp"
#include "services/tsgctl/run/log_tail.hpp"

namespace tsg {
namespace {

using std::chrono::milliseconds;

constexpr milliseconds kStartTimeout{10'000};
constexpr milliseconds kProbePeriod{20};
constexpr milliseconds kStopGrace{500};

std::string log_end(const std::filesystem::path& log_file) {
  return "; its log, " + log_file.string() + ", ends with\n" + log_tail(log_file, kLogLinesShown);
}

}  // namespace

RoudiProcess::RoudiProcess(const std::filesystem::path& log_file, const std::stop_token& stop) {
  if (check_roudi()) return;
  const std::filesystem::path config = value_or_throw(find_config_file("roudi.toml"));
  ChildCommand command;
  command.program = "iox-roudi";
  // It would drop a process that was kept waiting for 1.5 s, and never let it back in. What a
  // killed one leaves behind need not be cleared here: a run ends with the first service that dies.
  command.arguments = {"--config-file", config.string(), "--monitoring-mode", "off"};
  command.output_file = log_file;
  auto child = ChildProcess::spawn(command);
  if (!child) {
    throw FatalError(ExitCode::kUnavailable, child.error().message +
                                                 "; RouDi is in the package iceoryx: run "
                                                 "deploy/install-deps");
  }
  child_ = std::move(*child);
  wait_until_it_answers(log_file, stop);
}

void RoudiProcess::wait_until_it_answers(const std::filesystem::path& log_file,
                                         const std::stop_token& stop) {
  const auto deadline = std::chrono::steady_clock::now() + kStartTimeout;
  while (!stop.stop_requested()) {
    if (const auto& end = child_->wait(kProbePeriod)) {
      throw FatalError(ExitCode::kUnavailable, "RouDi could not start (" + end->describe() +
                                                   "); tsgctl doctor tells more" +
                                                   log_end(log_file));
    }
    if (check_roudi()) return;
    if (std::chrono::steady_clock::now() > deadline) {
      throw FatalError(ExitCode::kTimeout, "RouDi does not answer" + log_end(log_file));
    }
  }
}

RoudiProcess::~RoudiProcess() {
  if (child_) child_->terminate(kStopGrace);
}

}  // namespace tsg
