#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "common/core/error.hpp"
#include "common/simulation/scene.hpp"

namespace tsg {

/// What the command line changes of a scene; what is absent stays as the scene says.
struct SceneOptions {
  std::optional<std::uint64_t> seed = {};
  std::string noise = {};  ///< "all", "none", or parts of the sensor model, separated by commas
  std::string size = {};   ///< "320x240"
};

/// kUsage for a part of the sensor model or a size that there is not.
[[nodiscard]] Expected<void> apply(const SceneOptions& options,
                                   simulation::SceneDescription& scene);

}  // namespace tsg
