#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/render/mesh.hpp"
#include "common/simulation/furniture/paint.hpp"

namespace tsg::simulation {

/// The material of a floor or wall; `name` must be one of surface_names() (room.hpp). `colour`
/// replaces the surface's own. For shapes whose uv is in metres.
[[nodiscard]] render::Material make_surface(const std::string& name,
                                            const std::optional<paint::Colour>& colour,
                                            std::uint64_t seed);

}  // namespace tsg::simulation
