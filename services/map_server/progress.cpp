#include "services/map_server/progress.hpp"

namespace tsg {

void Progress::add_integrated(double integration_ms) {
  const std::scoped_lock lock(mutex_);
  ++counts_.integrated;
  integration_ms_.add(integration_ms);
  changed_.notify_all();
}

void Progress::add_rejected(const std::string& why) {
  const std::scoped_lock lock(mutex_);
  ++counts_.rejected;
  counts_.last_rejection = why;
  changed_.notify_all();
}

void Progress::add_discarded() {
  const std::scoped_lock lock(mutex_);
  ++counts_.discarded;
  changed_.notify_all();
}

bool Progress::set_missed(std::uint64_t total) {
  const std::scoped_lock lock(mutex_);
  if (total <= counts_.missed) return false;
  counts_.missed = total;
  changed_.notify_all();
  return true;
}

KeyframeCounts Progress::counts() const {
  const std::scoped_lock lock(mutex_);
  return counts_;
}

Summary Progress::integration_ms() const {
  const std::scoped_lock lock(mutex_);
  return integration_ms_.summary();
}

bool Progress::wait_for_settled(std::uint64_t keyframes,
                                std::chrono::milliseconds timeout,
                                const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  return changed_.wait_for(lock, stop, timeout, [&] { return counts_.settled() >= keyframes; });
}

}  // namespace tsg
