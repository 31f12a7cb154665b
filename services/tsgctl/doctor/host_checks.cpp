#include "services/tsgctl/doctor/host_checks.hpp"

#include <unistd.h>

#include <cstddef>
#include <filesystem>
#include <string>
#include <system_error>

#include "common/bus/messages.hpp"
#include "common/bus/pools.hpp"
#include "common/bus/roudi.hpp"
#include "services/tsgctl/doctor/multicast_check.hpp"
#include "services/tsgctl/lib/text_format.hpp"

namespace tsg {
namespace {

namespace fs = std::filesystem;

constexpr const char* kSharedMemory = "/dev/shm";
constexpr const char* kManagementSegment = "/dev/shm/iceoryx_mgmt";
constexpr const char* kRoudiLock = "/tmp/roudi.lock";
/// RouDi's management data: fixed by the limits that Debian compiles iceoryx 2.0 with.
constexpr std::uint64_t kManagementBytes = 65'723'752;

std::uint64_t pool_bytes() {
  std::uint64_t bytes = 0;
  for (const RoudiPool& pool : kRoudiPools) bytes += pool.chunk_bytes * pool.chunks;
  return bytes;
}

CheckResult check_shared_memory(bool roudi_answers) {
  std::error_code error;
  const fs::space_info space = fs::space(kSharedMemory, error);
  if (error) {
    return failed("shared memory", std::string(kSharedMemory) + ": " + error.message(),
                  "mount -t tmpfs tmpfs /dev/shm");
  }
  return judge_shared_memory(space.capacity, space.available, roudi_answers);
}

CheckResult check_roudi_answers(bool answers) {
  if (answers) return passed("RouDi", std::string("answers at ") + kRoudiSocket);
  if (access(kRoudiSocket, F_OK) != 0) {
    return warned("RouDi", "does not run",
                  "tsgctl run starts one for itself; for services of their own: systemctl start "
                  "iox-roudi");
  }
  return warned("RouDi",
                std::string(kRoudiSocket) + " is there, but nobody answers: a RouDi was killed",
                "start RouDi again, it cleans up; services of the time before must restart too");
}

/// Segments that are there belong to a RouDi of this user, or nothing works.
CheckResult check_permissions() {
  for (const char* path : {kManagementSegment, kRoudiSocket, kRoudiLock}) {
    if (access(path, F_OK) == 0 && access(path, R_OK | W_OK) != 0) {
      return failed("permissions", std::string(path) + " belongs to another user",
                    "run RouDi and all services as one user; remove what another has left behind");
    }
  }
  return passed("permissions", "RouDi's files are ours, or not there yet");
}

/// Whether some segment is as large as the shipped pools: a RouDi that was started with another
/// configuration aborts the first service that asks for an image.
CheckResult check_running_pools(bool roudi_answers) {
  const std::string need = "the shipped pools take " + format_bytes(pool_bytes());
  if (!roudi_answers) return passed("pools", need + "; every message type fits (built in)");
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(kSharedMemory, error)) {
    std::error_code ignored;  // of a file that goes meanwhile
    if (entry.path() == kManagementSegment || !entry.is_regular_file(ignored)) continue;
    if (entry.file_size(ignored) >= pool_bytes() && !ignored) {
      return passed("pools", need + "; RouDi's segment " + entry.path().string() + " has them");
    }
  }
  return failed("pools", need + ", but the running RouDi has no segment of that size",
                "restart RouDi with the shipped configuration: iox-roudi -c config/roudi.toml");
}

}  // namespace

std::uint64_t needed_shared_memory_bytes() {
  // Chunk headers and the lists of free chunks take about a hundredth.
  return pool_bytes() + pool_bytes() / 100 + kManagementBytes;
}

CheckResult judge_shared_memory(std::uint64_t total_bytes,
                                std::uint64_t available_bytes,
                                bool roudi_has_its_share) {
  const std::uint64_t needed = needed_shared_memory_bytes();
  const std::string has = std::string(kSharedMemory) + " has " + format_bytes(total_bytes) + ", " +
                          format_bytes(available_bytes) + " free; RouDi takes " +
                          format_bytes(needed);
  if (roudi_has_its_share || available_bytes >= needed) return passed("shared memory", has);
  if (total_bytes >= needed) {
    return failed("shared memory", has,
                  "remove what others left there (ls -la /dev/shm), or make it larger: mount -o "
                  "remount,size=1G /dev/shm");
  }
  return failed("shared memory", has,
                "mount -o remount,size=1G /dev/shm; in a container: docker run --shm-size=1g");
}

std::vector<CheckResult> check_host() {
  const bool roudi_answers = check_roudi().has_value();
  return {check_shared_memory(roudi_answers), check_roudi_answers(roudi_answers),
          check_permissions(), check_running_pools(roudi_answers), check_multicast()};
}

}  // namespace tsg
