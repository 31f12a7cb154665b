#pragma once

#include <cstdlib>
#include <filesystem>

namespace tsg::testing_support {

/// Where recorded sequences and models lie: TSG_SHARED_DIR, else what CMake was told. Tests skip
/// where what they need is absent.
inline std::filesystem::path shared_dir() {
  const char* dir = std::getenv("TSG_SHARED_DIR");  // NOLINT(concurrency-mt-unsafe): never set
  return dir != nullptr ? dir : TSG_DEFAULT_SHARED_DIR;
}

}  // namespace tsg::testing_support
