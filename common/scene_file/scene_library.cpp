#include "common/scene_file/scene_library.hpp"

#include <algorithm>
#include <map>
#include <system_error>

#include "common/scene_file/scene_problems.hpp"

namespace tsg {

namespace fs = std::filesystem;

SceneLibrary::SceneLibrary(const std::vector<fs::path>& folders) {
  std::map<std::string, fs::path> by_name;
  for (const fs::path& folder : folders) {
    std::error_code absent;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, absent)) {
      if (entry.path().extension() != ".yaml") continue;
      by_name.emplace(entry.path().stem().string(), entry.path());
    }
  }
  for (const auto& [name, file] : by_name) files_.push_back(file);
}

Expected<fs::path> SceneLibrary::find(const std::string& name_or_file) const {
  const fs::path path(name_or_file);
  if (path.has_parent_path() || path.extension() == ".yaml") {
    if (fs::is_regular_file(path)) return path;
    return make_error(ExitCode::kMissingInput,
                      "there is no file " + name_or_file + "; give a scene (docs/simulation.md)");
  }
  std::vector<std::string> names;
  for (const fs::path& file : files_) {
    if (file.stem() == name_or_file) return file;
    names.push_back(file.stem().string());
  }
  return make_error(ExitCode::kMissingInput,
                    "there is no scene \"" + name_or_file + "\"; " +
                        suggestion(name_or_file, names) +
                        " (tsgctl simulate --list tells of all; a file of your own: its path)");
}

}  // namespace tsg
