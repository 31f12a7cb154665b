#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

namespace tsg::test {

/// Folder of recorded sequences and models: the environment's TSG_SHARED_DIR, else CMake's.
[[nodiscard]] inline std::filesystem::path shared_dir() {
  const char* chosen = std::getenv("TSG_SHARED_DIR");  // NOLINT(concurrency-mt-unsafe): in tests
  return chosen != nullptr ? chosen : TSG_DEFAULT_SHARED_DIR;
}

}  // namespace tsg::test

/// Skips the test, saying so, where `relative_path` of the shared folder is absent:
///   TSG_REQUIRE_SHARED("data/rendered/walking_xyz");
#define TSG_REQUIRE_SHARED(relative_path)                                               \
  do {                                                                                  \
    const auto needed = ::tsg::test::shared_dir() / (relative_path);                    \
    if (!std::filesystem::exists(needed)) {                                             \
      GTEST_SKIP() << needed << " is absent; set TSG_SHARED_DIR to the folder with it"; \
    }                                                                                   \
  } while (false)
