#include "services/tsgctl/bench/process_use.hpp"

#include <ctime>
#include <fstream>
#include <string>

namespace tsg {
namespace {

/// A line of /proc/self/status, for example "VmRSS:   12345 kB"; kB means KiB there.
double status_mib(const std::string& name) {
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;) {
    double kib = 0.0;
    if (word == name && status >> kib) return kib / 1024.0;
  }
  return 0.0;
}

}  // namespace

std::int64_t thread_cpu_ns() {
  timespec time{};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return time.tv_sec * 1'000'000'000LL + time.tv_nsec;
}

double resident_mib() { return status_mib("VmRSS:"); }

// Not getrusage(): its figure may be that of the program which started this one.
double peak_resident_mib() { return status_mib("VmHWM:"); }

}  // namespace tsg
