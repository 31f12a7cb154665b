#include "services/segmentation/scheduling.hpp"

#include <sched.h>
#include <sys/resource.h>
#include <unistd.h>

#include <charconv>
#include <optional>
#include <set>
#include <string_view>
#include <system_error>

namespace tsg {

namespace {

constexpr int kMostCpus = CPU_SETSIZE;

/// A number at the start of `text`, which is then behind it.
std::optional<int> take_number(std::string_view& text) {
  int number = 0;
  const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (failure != std::errc() || number < 0 || number >= kMostCpus) return std::nullopt;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return number;
}

bool take(std::string_view& text, char wanted) {
  if (text.empty() || text.front() != wanted) return false;
  text.remove_prefix(1);
  return true;
}

/// "2" or "2-3".
bool take_range(std::string_view& text, std::set<int>& cpus) {
  const auto first = take_number(text);
  if (!first) return false;
  const auto last = take(text, '-') ? take_number(text) : first;
  if (!last || *last < *first) return false;
  for (int cpu = *first; cpu <= *last; ++cpu) cpus.insert(cpu);
  return true;
}

void check_present(const std::vector<int>& cpus) {
  const long present = ::sysconf(_SC_NPROCESSORS_CONF);
  for (const int cpu : cpus) {
    if (cpu < present) continue;
    throw FatalError(ExitCode::kConfig, "segmentation.cpus names CPU " + std::to_string(cpu) +
                                            ", but this host has CPUs 0 to " +
                                            std::to_string(present - 1) +
                                            ": name some of these, or none to use all");
  }
}

void pin_to(const std::vector<int>& cpus) {
  check_present(cpus);
  cpu_set_t wanted;
  CPU_ZERO(&wanted);
  for (const int cpu : cpus) CPU_SET(static_cast<std::size_t>(cpu), &wanted);
  const bool is_set = ::sched_setaffinity(0, sizeof(wanted), &wanted) == 0;
  const std::string why = is_set ? "not all of them are this process's to use" : errno_text();
  cpu_set_t given;  // the kernel leaves out those that a container or cpuset withholds
  CPU_ZERO(&given);
  if (is_set && ::sched_getaffinity(0, sizeof(given), &given) == 0 && CPU_EQUAL(&wanted, &given)) {
    return;
  }
  throw FatalError(ExitCode::kUnavailable,
                   "cannot run on the CPUs that segmentation.cpus names: " + why +
                       "; allow them (container, systemd AllowedCPUs=) or name others");
}

void lower_priority(int nice, Log& log) {
  if (::getpriority(PRIO_PROCESS, 0) >= nice) return;
  if (::setpriority(PRIO_PROCESS, 0, nice) != 0) {
    log.warn("priority not lowered", {{"why", errno_text()}});
  }
}

}  // namespace

std::vector<std::string> Scheduling::problems() const {
  std::vector<std::string> found;
  if (nice < 0 || nice > 19) found.emplace_back("nice must be 0 to 19");
  if (!cpus.empty()) {
    if (const auto list = parse_cpu_list(cpus); !list) {
      found.push_back("cpus " + list.error().message);
    }
  }
  return found;
}

Expected<std::vector<int>> parse_cpu_list(const std::string& text) {
  std::set<int> cpus;
  std::string_view rest = text;
  bool is_list = take_range(rest, cpus);
  while (is_list && !rest.empty()) is_list = take(rest, ',') && take_range(rest, cpus);
  if (is_list) return std::vector<int>(cpus.begin(), cpus.end());
  return make_error(ExitCode::kConfig,
                    "must be numbers of CPUs, such as 1 or 2-3,6, not '" + text + "'");
}

void apply(const Scheduling& scheduling, Log& log) {
  if (!scheduling.cpus.empty()) pin_to(value_or_throw(parse_cpu_list(scheduling.cpus)));
  lower_priority(scheduling.nice, log);
}

}  // namespace tsg
