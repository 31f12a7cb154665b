#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace tsg {

/// A file that was loaded once, and whether it is still the same: replacing it does nothing until
/// the service starts anew, which whoever replaced it wants to know.
class ModelFile {
 public:
  /// Notes what is there now.
  explicit ModelFile(std::filesystem::path path);

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

  /// A sentence of what has become of the file since, with the fix; empty: nothing.
  [[nodiscard]] std::string change() const;

 private:
  /// What changes when a file is written to or replaced.
  struct Mark {
    std::uint64_t inode = 0;
    std::int64_t bytes = 0;
    std::int64_t seconds = 0;
    std::int64_t nanoseconds = 0;
    bool operator==(const Mark&) const = default;
  };
  [[nodiscard]] std::optional<Mark> mark() const;

  std::filesystem::path path_;
  std::optional<Mark> loaded_;
};

}  // namespace tsg
