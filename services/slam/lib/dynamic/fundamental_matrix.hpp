#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <span>

#include "services/slam/lib/dynamic/pair_consensus.hpp"
#include "services/slam/lib/dynamic/pixel_pair.hpp"

namespace tsg {

inline constexpr std::size_t kMinFundamentalPairs = 8;

/// The fundamental matrix F of p2^T F p1 = 0 (paper eq. 1) by the normalised eight-point algorithm
/// (eq. 2-4; Hartley 1997), of rank 2 and norm 1. Nothing for fewer than eight pairs, and where
/// they leave more than one solution: pixels that coincide or lie on a line, and exact pairs
/// without parallax (a plane, a camera that only turns or stands still). With noise the latter give
/// some matrix; estimate_two_views() tells.
[[nodiscard]] std::optional<Eigen::Matrix3d> eight_point(std::span<const PixelPair> pairs);

/// Distance in pixels of p2 from the epipolar line F p1: how far the pair is from what does not
/// move. Infinite at the epipole itself, which has no line.
[[nodiscard]] double epipolar_distance(const Eigen::Matrix3d& F,
                                       const Eigen::Vector2d& p1,
                                       const Eigen::Vector2d& p2);

/// eight_point() among wrong pairs, by consensus; a pair agrees that is near its line in both
/// images.
[[nodiscard]] std::optional<Consensus> estimate_fundamental(std::span<const PixelPair> pairs,
                                                            const ConsensusLimits& limits);

}  // namespace tsg
