#pragma once

#include <sys/mount.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "tests/support/temp_folder.hpp"

namespace tsg::test {

/// A disk of its own, of a given size, as long as the object lives.
class TinyDisk {
 public:
  explicit TinyDisk(const std::string& size) {
    std::filesystem::create_directories(path());
    const std::string options = "size=" + size;
    is_mounted_ = mount("tmpfs", path().c_str(), "tmpfs", 0, options.c_str()) == 0;
  }
  ~TinyDisk() {
    if (is_mounted_) umount2(path().c_str(), MNT_DETACH);
  }
  TinyDisk(const TinyDisk&) = delete;
  TinyDisk& operator=(const TinyDisk&) = delete;
  TinyDisk(TinyDisk&&) = delete;
  TinyDisk& operator=(TinyDisk&&) = delete;

  [[nodiscard]] bool is_mounted() const { return is_mounted_; }
  [[nodiscard]] std::filesystem::path path() const { return folder_ / "disk"; }
  /// Writes until nothing fits any more.
  void fill() const {
    std::ofstream filler(path() / "filler", std::ios::binary);
    const std::string block(65536, 'x');
    while (filler << block << std::flush) {
    }
  }

 private:
  TempFolder folder_;
  bool is_mounted_ = false;
};

}  // namespace tsg::test
