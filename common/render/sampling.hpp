#pragma once

#include <Eigen/Core>
#include <cstdint>

namespace tsg::render {

/// Point `index` of `count` that are spread evenly over the unit square (Hammersley), shifted by a
/// chance of its own for each `salt`, so that neighbours do not share their errors.
[[nodiscard]] Eigen::Vector2f spread_point(int index, int count, std::uint32_t salt);

/// Direction of the hemisphere around `normal`, as likely as light is strong there (cosine law);
/// `where` lies in the unit square.
[[nodiscard]] Eigen::Vector3f cosine_direction(const Eigen::Vector3f& normal,
                                               const Eigen::Vector2f& where);

/// Direction of the whole sphere, all equally likely.
[[nodiscard]] Eigen::Vector3f sphere_direction(const Eigen::Vector2f& where);

}  // namespace tsg::render
