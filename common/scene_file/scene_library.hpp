#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "common/core/error.hpp"

namespace tsg {

/// The scenes of several folders, each a NAME.yaml.
class SceneLibrary {
 public:
  /// Folders that do not exist count as empty; of scenes with one name that of the first counts.
  explicit SceneLibrary(const std::vector<std::filesystem::path>& folders);

  /// By name.
  [[nodiscard]] const std::vector<std::filesystem::path>& files() const { return files_; }

  /// The file of "what a user names": a scene of the library by its name, or any file by its path.
  /// kMissingInput lists the scenes there are.
  [[nodiscard]] Expected<std::filesystem::path> find(const std::string& name_or_file) const;

 private:
  std::vector<std::filesystem::path> files_;
};

}  // namespace tsg
