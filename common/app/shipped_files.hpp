#pragma once

#include <filesystem>
#include <vector>

#include "common/core/error.hpp"

namespace tsg {

/// The folder that this program lies in.
[[nodiscard]] std::filesystem::path program_folder();

/// Where shipped configuration may lie: beside the installed program, then in the source folder.
[[nodiscard]] std::vector<std::filesystem::path> config_folders();

/// A file of config/, e.g. "roudi.toml". kMissingInput, naming where it was looked for.
[[nodiscard]] Expected<std::filesystem::path> find_config_file(const std::filesystem::path& name);

/// The network that segmentation runs where none is named. It has learnt from simulated rooms only
/// (config/models/model-card.md). kMissingInput as above.
[[nodiscard]] Expected<std::filesystem::path> find_shipped_network();

}  // namespace tsg
