#pragma once

#include <chrono>
#include <stop_token>
#include <string>
#include <vector>

#include "common/bus/bus.hpp"
#include "common/bus/qos.hpp"

namespace tsg {

enum class Transport {
  kSharedMemory,
  kUdp,
  kUnknown,  ///< in the shared-memory domain, but not one of our processes: it did not say
};

/// The process that a writer or reader belongs to, as far as it has told.
struct Peer {
  std::string host;
  std::string process;
  int pid = 0;
  Transport transport = Transport::kUdp;
};

/// A topic that somebody writes or reads at the moment.
struct TopicInfo {
  std::string name;
  std::string type;  ///< DDS type name, e.g. "tsg::RgbdFrame"
  Domain domain = Domain::kStandard;
  int domain_id = 0;
  std::vector<Peer> writers;
  std::vector<Peer> readers;
};

/// Every topic in both domains, by name, with the writers and readers of all other participants;
/// endpoints of `bus` itself are left out. Peers need `wait` to be found; a second is plenty on
/// one host.
[[nodiscard]] std::vector<TopicInfo> discover_topics(Bus& bus,
                                                     std::chrono::milliseconds wait,
                                                     const std::stop_token& stop = {});

}  // namespace tsg
