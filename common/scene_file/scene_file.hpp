#pragma once

#include <filesystem>

#include "common/core/error.hpp"
#include "common/simulation/scene.hpp"

namespace tsg {

/// Reads a scene (docs/simulation.md). All that is wrong is listed, a line each with file, line and
/// key: not YAML, unknown or missing keys, wrong types, numbers out of range or not finite, unknown
/// types, surfaces and names. kMissingInput where there is no such file, kConfig otherwise.
[[nodiscard]] Expected<simulation::SceneDescription> load_scene(const std::filesystem::path& file);

}  // namespace tsg
