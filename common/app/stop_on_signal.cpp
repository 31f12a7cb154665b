#include "common/app/stop_on_signal.hpp"

#include <csignal>
#include <ctime>

namespace tsg {
namespace {

constexpr timespec kEndCheckPeriod{.tv_sec = 0, .tv_nsec = 50'000'000};

sigset_t stop_signals() {
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGTERM);
  sigaddset(&signals, SIGINT);
  return signals;
}

}  // namespace

StopOnSignal::StopOnSignal() {
  const sigset_t signals = stop_signals();
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  waiter_ = std::jthread([this](const std::stop_token& end) { wait(end); });
}

void StopOnSignal::wait(const std::stop_token& end) {
  const sigset_t signals = stop_signals();
  while (!end.stop_requested()) {
    const int received = sigtimedwait(&signals, nullptr, &kEndCheckPeriod);
    if (received > 0) {
      signal_ = received;
      source_.request_stop();
    }
  }
}

void unblock_stop_signals() {
  const sigset_t signals = stop_signals();
  pthread_sigmask(SIG_UNBLOCK, &signals, nullptr);
}

}  // namespace tsg
