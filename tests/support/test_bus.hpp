#pragma once

#include <chrono>
#include <map>
#include <memory>
#include <optional>
#include <typeindex>

#include "common/bus/bus.hpp"
#include "common/bus/topics.hpp"
#include "tests/support/running_roudi.hpp"

namespace tsg::test {

/// A bus for a test, with RouDi running where `config` asks for shared memory, and the other side
/// of whatever is tested:
///   TestBus bus;
///   bus.watch<topics::TrackingStatus>();
///   bus.publish<topics::Rgbd>([](tsg_RgbdFrame& message) { ... });
///   ASSERT_TRUE(bus.wait_for<topics::TrackingStatus>(2s, is_lost));
class TestBus {
 public:
  explicit TestBus(const BusConfig& config = {}) : bus_(with_roudi(config)) {}

  [[nodiscard]] Bus& bus() { return bus_; }

  /// Subscribes; what is published from now on can be waited for. Waits for a publisher.
  template <typename Topic>
  [[nodiscard]] bool watch(std::chrono::milliseconds timeout = std::chrono::seconds(5)) {
    return subscriber<Topic>().wait_for_publishers(1, timeout);
  }

  /// Publishes what `fill` makes of a zeroed message; false where nobody subscribes within 5 s.
  template <typename Topic, typename Fill>
  [[nodiscard]] bool publish(Fill fill) {
    Publisher<Topic>& to = publisher<Topic>();
    if (!to.wait_for_subscribers(1, std::chrono::seconds(5))) return false;
    const auto message = std::make_unique<typename Topic::Message>();
    fill(*message);
    return to.publish(*message).has_value();
  }

  /// The first sample from here on that `is_wanted`, if one comes in time.
  template <typename Topic, typename Predicate>
  [[nodiscard]] std::optional<Sample<Topic>> wait_for(std::chrono::milliseconds timeout,
                                                      Predicate is_wanted) {
    const auto deadline = std::chrono::steady_clock::now() + timeout;
    while (std::chrono::steady_clock::now() < deadline) {
      const auto left =
          std::chrono::ceil<std::chrono::milliseconds>(deadline - std::chrono::steady_clock::now());
      auto sample = subscriber<Topic>().take({}, left);
      if (sample && is_wanted(**sample)) return sample;
    }
    return std::nullopt;
  }

  template <typename Topic>
  [[nodiscard]] Publisher<Topic>& publisher() {
    return endpoint<Publisher<Topic>>();
  }
  template <typename Topic>
  [[nodiscard]] Subscriber<Topic>& subscriber() {
    return endpoint<Subscriber<Topic>>();
  }

 private:
  static const BusConfig& with_roudi(const BusConfig& config) {
    if (config.use_shared_memory) RunningRoudi::instance();
    return config;
  }

  template <typename Endpoint>
  Endpoint& endpoint() {
    auto& held = endpoints_[typeid(Endpoint)];
    if (!held) held = std::make_shared<Endpoint>(bus_);
    return *static_cast<Endpoint*>(held.get());
  }

  Bus bus_;
  std::map<std::type_index, std::shared_ptr<void>> endpoints_;  // after the bus: go first
};

}  // namespace tsg::test
