#include "services/tsgctl/topic_wait.hpp"

#include <iostream>
#include <utility>

#include "common/core/error.hpp"
#include "services/tsgctl/lib/text_format.hpp"

namespace tsg {
namespace {

constexpr std::chrono::seconds kPatience{2};

std::string silence(const std::string& topic, int publishers) {
  return publishers > 0 ? topic + " has a publisher, but nothing comes"
                        : "nobody publishes " + topic + " (tsgctl topics lists what there is)";
}

}  // namespace

TopicWait::TopicWait(std::string topic, double timeout_s)
    : topic_(std::move(topic)), timeout_(timeout_s) {}

void TopicWait::nothing_came(int publishers) {
  const auto silent_for = Clock::now() - last_;
  if (timeout_.count() > 0.0 && silent_for > timeout_) {
    throw FatalError(ExitCode::kTimeout,
                     silence(topic_, publishers) + " within " + fixed(timeout_.count(), 1) + " s");
  }
  if (has_said_so_ || silent_for < kPatience) return;
  has_said_so_ = true;
  std::cerr << silence(topic_, publishers) << "; waiting, Ctrl-C ends" << std::endl;
}

}  // namespace tsg
