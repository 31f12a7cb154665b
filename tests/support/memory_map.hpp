#pragma once

#include <string>

namespace tsg::test {

/// The file that is mapped where `address` points, "" for the heap and the like; from
/// /proc/self/maps. Chunks of shared memory lie in a file of /dev/shm.
[[nodiscard]] std::string mapped_file_at(const void* address);

/// Whether `address` lies in the segment that RouDi hands out to this user.
[[nodiscard]] bool is_in_shared_segment(const void* address);

}  // namespace tsg::test
