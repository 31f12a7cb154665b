#include "common/app/shipped_files.hpp"

#include <string>

namespace tsg {

std::filesystem::path program_folder() {
  return std::filesystem::read_symlink("/proc/self/exe").parent_path();
}

std::vector<std::filesystem::path> config_folders() {
  return {(program_folder() / "../share/tsg-slam/config").lexically_normal(),
          TSG_SOURCE_DIR "/config"};
}

Expected<std::filesystem::path> find_config_file(const std::filesystem::path& name) {
  std::string places;
  for (const std::filesystem::path& folder : config_folders()) {
    if (std::filesystem::exists(folder / name)) return folder / name;
    places += (places.empty() ? "neither " : " nor ") + (folder / name).string();
  }
  return make_error(ExitCode::kMissingInput,
                    name.string() + " is " + places + "; install TSG-SLAM again");
}

Expected<std::filesystem::path> find_shipped_network() {
  return find_config_file("models/solov2-rooms.onnx");
}

}  // namespace tsg
