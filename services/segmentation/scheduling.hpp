#pragma once

#include <string>
#include <vector>

#include "common/app/log.hpp"
#include "common/core/error.hpp"

namespace tsg {

/// Which share of the machine a thread, and all threads that it starts from then on, may have.
struct Scheduling {
  std::string cpus = {};  // as taskset -c writes it: "1", "2-3,6"; empty: any
  int nice = 5;           // 0 to 19: on a busy machine tracking must win over masks

  [[nodiscard]] std::vector<std::string> problems() const;
};

/// The numbers in a list such as "0,2-3", ascending; kConfig where it is none.
[[nodiscard]] Expected<std::vector<int>> parse_cpu_list(const std::string& text);

/// Sets it for the calling thread. Throws FatalError: kConfig where this host lacks one of the
/// CPUs, kUnavailable where the process may not use it. A priority that cannot be had is a warning,
/// one that is lower already stays.
void apply(const Scheduling& scheduling, Log& log);

}  // namespace tsg
