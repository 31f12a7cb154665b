#pragma once

#include <string>
#include <vector>

namespace tsg {

/// How this process joins the bus. Defaults are what the shipped configuration runs on.
struct BusConfig {
  int standard_domain = 0;
  int shared_memory_domain = 10;
  /// Network interface that the standard domain goes over, beside lo; shared memory never leaves
  /// the host.
  std::string interface = "lo";
  /// False sends images over UDP as well: for tests and for hosts without RouDi; slow.
  bool use_shared_memory = true;

  /// What is wrong with it, a sentence each; empty where it is sound.
  [[nodiscard]] std::vector<std::string> problems() const;
};

}  // namespace tsg
