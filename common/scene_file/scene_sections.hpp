#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "common/scene_file/map_reader.hpp"
#include "common/scene_file/scene_names.hpp"
#include "common/simulation/scene.hpp"

namespace tsg {

/// What the simulator can make.
struct Catalogue {
  std::vector<std::string> furniture;
  std::vector<std::string> surfaces;
};

/// What the readers of sections share.
struct SceneContext {
  const Catalogue& catalogue;
  std::filesystem::path folder;  ///< of the scene file
  SceneProblems& problems;
  SceneNames names = {};
};

/// Each reads a section of the file into `scene`. Rooms come first: the others look where they are.
void read_rooms(MapReader& root, SceneContext& context, simulation::SceneDescription& scene);
void read_openings(MapReader& root, SceneContext& context, simulation::SceneDescription& scene);
void read_objects(MapReader& root, SceneContext& context, simulation::SceneDescription& scene);
void read_people(MapReader& root, SceneContext& context, simulation::SceneDescription& scene);
void read_relocations(MapReader& root, SceneContext& context, simulation::SceneDescription& scene);
void read_moves(MapReader& root, SceneContext& context, simulation::SceneDescription& scene);
void read_camera(MapReader& root, SceneContext& context, simulation::SceneDescription& scene);
void read_sensor(MapReader& root, SceneContext& context, simulation::SceneDescription& scene);

/// load_scene() with the names that a simulator knows.
[[nodiscard]] Expected<simulation::SceneDescription> load_scene_with(
    const Catalogue& catalogue, const std::filesystem::path& file);

/// Whether a place is in some room, or not farther than `margin_m` from one. True where there is no
/// room: that is told elsewhere.
[[nodiscard]] bool is_in_a_room(const simulation::SceneDescription& scene,
                                const Eigen::Vector2d& position_m,
                                double margin_m);

}  // namespace tsg
