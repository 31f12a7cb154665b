#include "common/scene_file/scene_file.hpp"

#include "common/scene_file/scene_sections.hpp"
#include "common/simulation/furniture/catalogue.hpp"
#include "common/simulation/furniture/room.hpp"

namespace tsg {

Expected<simulation::SceneDescription> load_scene(const std::filesystem::path& file) {
  return load_scene_with({simulation::furniture_types(), simulation::surface_names()}, file);
}

}  // namespace tsg
