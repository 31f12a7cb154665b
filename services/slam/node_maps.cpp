// What SlamNode does about map files: it starts in one, saves its map into one, and changes over to
// another while it runs.
#include <nlohmann/json.hpp>
#include <utility>

#include "services/slam/node.hpp"

namespace tsg {
namespace {

Expected<std::filesystem::path> file_of(const nlohmann::json& argument, const std::string& verb) {
  const auto file = argument.find("file");
  if (file != argument.end() && file->is_string() && !file->get<std::string>().empty()) {
    return std::filesystem::path(file->get<std::string>());
  }
  return make_error(ExitCode::kUsage, verb + R"( needs {"file": "..."}, the path of a map file)");
}

}  // namespace

void SlamNode::add_map_commands() {
  commands_.on_lasting("save_map",
                       [this](const std::string& argument) { return save_map(argument); });
  commands_.on_lasting("load_map",
                       [this](const std::string& argument) { return load_map(argument); });
  commands_.on("map_info",
               [this](const std::string&) -> Expected<std::string> { return map_info(); });
}

void SlamNode::start_in_map(const std::filesystem::path& file) {
  enter(value_or_throw(read_map(file, config_.core)));
}

Expected<CommandServer::Pending> SlamNode::save_map(const std::string& argument_json) {
  const auto file = file_of(nlohmann::json::parse(argument_json), "save_map");
  if (!file) return tl::unexpected(file.error());
  if (session_ == nullptr || session_->mapping.snapshot()->map_keyframes == 0) {
    return make_error(ExitCode::kEmptyInput,
                      "there is no map to save: no frame has been tracked yet");
  }
  log_.info("saving the map", {{"file", file->string()}});
  return begin_to_write(*file, session_->mapping.contents(), config_.core.features);
}

Expected<CommandServer::Pending> SlamNode::load_map(const std::string& argument_json) {
  const auto argument = nlohmann::json::parse(argument_json);
  const auto file = file_of(argument, "load_map");
  if (!file) return tl::unexpected(file.error());
  SlamConfig config = config_.core;
  if (const auto only = argument.find("localisation_only"); only != argument.end()) {
    if (!only->is_boolean()) {
      return make_error(ExitCode::kUsage, R"(load_map: "localisation_only" must be true or false)");
    }
    config.tracker.localisation_only = only->get<bool>();
  }
  return begin_to_read(*file, config, [this, config](LoadedMap&& map) -> Expected<std::string> {
    if (session_ != nullptr && last_stamp_ns_ != 0 && !(map.camera == session_->camera)) {
      return make_error(ExitCode::kConfig, other_camera(map.file, map.camera, session_->camera));
    }
    config_.core = config;
    enter(std::move(map));
    return map_info();
  });
}

/// Nothing of the old map may be mistaken for something of the new one.
void SlamNode::enter(LoadedMap&& map) {
  send(dense_keyframes_.flush());
  keyframes_.forget_places();
  trajectory_ = {};
  corrected_.reset();
  log_.info("map loaded", {{"file", map.file.string()},
                           {"keyframes", map.keyframes},
                           {"points", map.points},
                           {"localisation_only", config_.core.tracker.localisation_only}});
  const CameraModel camera = map.camera;
  session_ = std::make_unique<Session>(config_, camera, timer_, std::move(map.mapper));
  session_->map_file = std::move(map.file);
  session_->first_keyframe = map.newest + 1;
}

std::string SlamNode::other_camera(const std::filesystem::path& file,
                                   const CameraModel& of_map,
                                   const CameraModel& of_frames) {
  return "the map file " + file.string() + " was made with the camera " + of_map.describe() +
         "; the frames come from " + of_frames.describe() +
         ": load a map of this camera, or correct its intrinsics";
}

std::string SlamNode::map_info() {
  nlohmann::json info = {{"keyframes", 0},
                         {"points", 0},
                         {"state", to_text(state_)},
                         {"loaded_from", ""},
                         {"localisation_only", config_.core.tracker.localisation_only}};
  if (session_ != nullptr) {
    const auto map = session_->mapping.snapshot();
    info["keyframes"] = map->map_keyframes;
    info["points"] = map->map_points;
    info["loaded_from"] = session_->map_file.string();
    info["camera"] = session_->camera.describe();
  }
  return info.dump();
}

}  // namespace tsg
