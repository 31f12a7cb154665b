#include "services/tsgctl/run/progress.hpp"

#include <sys/ioctl.h>
#include <unistd.h>

#include <iostream>

#include "common/core/time.hpp"

namespace tsg {
namespace {

constexpr std::int64_t kBarPeriodNs = 100'000'000;
constexpr std::int64_t kLinePeriodNs = 2'000'000'000;
constexpr int kDefaultColumns = 80;

int terminal_columns() {
  winsize size{};
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-vararg): the only way to ask
  if (ioctl(STDERR_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col == 0) return kDefaultColumns;
  return size.ws_col;
}

}  // namespace

Progress::Progress() : is_terminal_(isatty(STDERR_FILENO) == 1) {}

Progress::~Progress() {
  if (bar_is_shown_) std::cerr << std::endl;
}

void Progress::update(const ProgressState& state) {
  const std::int64_t now = monotonic_ns();
  if (now - shown_at_ns_ < (is_terminal_ ? kBarPeriodNs : kLinePeriodNs)) return;
  shown_at_ns_ = now;
  draw(state);
}

void Progress::draw(const ProgressState& state) {
  if (is_terminal_) {
    // The last column stays free: writing there makes some terminals scroll.
    std::cerr << "\r\033[K" << progress_bar(state, terminal_columns() - 1) << std::flush;
    bar_is_shown_ = true;
  } else {
    std::cerr << progress_text(state) << std::endl;
  }
}

void Progress::say(const std::string& text) {
  clear_bar();
  std::cerr << text << std::endl;
}

void Progress::finish(const ProgressState& state) {
  draw(state);
  if (bar_is_shown_) std::cerr << std::endl;
  bar_is_shown_ = false;
}

void Progress::clear_bar() {
  if (bar_is_shown_) std::cerr << "\r\033[K";
  bar_is_shown_ = false;
}

}  // namespace tsg
