#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <span>

#include "services/slam/lib/dynamic/pair_consensus.hpp"
#include "services/slam/lib/dynamic/pixel_pair.hpp"

namespace tsg {

inline constexpr std::size_t kMinHomographyPairs = 4;

/// The homography H with p2 ~ H p1 by the normalised direct linear transformation, norm 1: what
/// relates two images without parallax. Nothing for fewer than four pairs, and where they leave
/// more than one solution (three pixels on a line).
[[nodiscard]] std::optional<Eigen::Matrix3d> fit_homography(std::span<const PixelPair> pairs);

/// Distance in pixels of p2 from H p1; infinite where that is not in front of the camera.
[[nodiscard]] double transfer_distance(const Eigen::Matrix3d& H,
                                       const Eigen::Vector2d& p1,
                                       const Eigen::Vector2d& p2);

/// fit_homography() among wrong pairs, by consensus.
[[nodiscard]] std::optional<Consensus> estimate_homography(std::span<const PixelPair> pairs,
                                                           const ConsensusLimits& limits);

}  // namespace tsg
