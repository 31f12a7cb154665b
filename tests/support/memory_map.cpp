#include "tests/support/memory_map.hpp"

#include <cstdint>
#include <fstream>
#include <sstream>

namespace tsg::test {

std::string mapped_file_at(const void* address) {
  // NOLINTNEXTLINE(*-reinterpret-cast): compared with the kernel's numbers
  const auto wanted = reinterpret_cast<std::uintptr_t>(address);
  std::ifstream maps("/proc/self/maps");
  for (std::string line; std::getline(maps, line);) {
    std::istringstream words(line);
    std::uintptr_t begin = 0;
    std::uintptr_t end = 0;
    char dash = 0;
    std::string permissions, offset, device, inode, path;
    words >> std::hex >> begin >> dash >> end >> permissions >> offset >> device >> inode >> path;
    if (wanted >= begin && wanted < end) return path;
  }
  return "";
}

bool is_in_shared_segment(const void* address) {
  const std::string file = mapped_file_at(address);
  return file.starts_with("/dev/shm/") && file != "/dev/shm/iceoryx_mgmt";
}

}  // namespace tsg::test
