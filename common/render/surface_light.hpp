#pragma once

#include <Eigen/Core>

#include "common/render/stage.hpp"

namespace tsg::render {

/// Unit normal at a sighting, turned towards the viewer.
[[nodiscard]] Eigen::Vector3f normal_at(const Stage& stage,
                                        const Sighting& sighting,
                                        const Ray& ray);

/// Radiance (linear BGR) that the surface at a sighting sends back along `ray`: its own light, what
/// it reflects of the light on it, and on glossy materials the image of lamps. `normal` as of
/// normal_at(); `pixel_angle` (radians) tells how much of a texture one pixel sees.
[[nodiscard]] Eigen::Vector3f radiance_towards(const Stage& stage,
                                               const Sighting& sighting,
                                               const Ray& ray,
                                               const Eigen::Vector3f& normal,
                                               float pixel_angle);

}  // namespace tsg::render
