#include "services/segmentation/lib/model_file.hpp"

#include <sys/stat.h>

#include <utility>

namespace tsg {

ModelFile::ModelFile(std::filesystem::path path) : path_(std::move(path)), loaded_(mark()) {}

std::optional<ModelFile::Mark> ModelFile::mark() const {
  struct stat found {};
  if (::stat(path_.c_str(), &found) != 0) return std::nullopt;
  return Mark{.inode = found.st_ino,
              .bytes = found.st_size,
              .seconds = found.st_mtim.tv_sec,
              .nanoseconds = found.st_mtim.tv_nsec};
}

std::string ModelFile::change() const {
  const auto present = mark();
  if (present == loaded_) return {};
  const std::string what = present ? " was replaced" : " is gone";
  return "the model file " + path_.string() + what +
         "; the network that was loaded at the start goes on: restart the service to take what is "
         "there then";
}

}  // namespace tsg
