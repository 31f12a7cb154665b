#include "services/slam/lib/dynamic/homography.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <limits>

#include "services/slam/lib/dynamic/null_vector.hpp"

namespace tsg {
namespace {

double distance_of(const Eigen::Matrix3d& H, const PixelPair& pair) {
  return transfer_distance(H, pair.p1, pair.p2);
}

/// Two rows for each pair.
NineColumns homography_equations(std::span<const PixelPair> pairs,
                                 const Normalisation& to_normalised) {
  NineColumns rows = NineColumns::Zero(static_cast<Eigen::Index>(2 * pairs.size()), 9);
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const Eigen::Vector3d p1 = to_normalised.N1 * pairs[i].p1.homogeneous();
    const Eigen::Vector3d p2 = to_normalised.N2 * pairs[i].p2.homogeneous();
    const auto row = static_cast<Eigen::Index>(2 * i);
    rows.row(row).head<3>() = p1;
    rows.row(row).tail<3>() = -p2.x() * p1;
    rows.row(row + 1).segment<3>(3) = p1;
    rows.row(row + 1).tail<3>() = -p2.y() * p1;
  }
  return rows;
}

}  // namespace

std::optional<Eigen::Matrix3d> fit_homography(std::span<const PixelPair> pairs) {
  if (pairs.size() < kMinHomographyPairs) return std::nullopt;
  const Normalisation to_normalised(pairs);
  const auto H_normalised = null_vector(homography_equations(pairs, to_normalised));
  if (!H_normalised) return std::nullopt;
  const Eigen::Matrix3d H = to_normalised.N2.inverse() * *H_normalised * to_normalised.N1;
  // The sign that puts the pixels in front of the second camera.
  const double side = (H * pairs.front().p1.homogeneous()).z();
  return (side < 0.0 ? -H : H).normalized();
}

double transfer_distance(const Eigen::Matrix3d& H,
                         const Eigen::Vector2d& p1,
                         const Eigen::Vector2d& p2) {
  const Eigen::Vector3d moved = H * p1.homogeneous();
  if (moved.z() <= 0.0) return std::numeric_limits<double>::infinity();
  return (moved.hnormalized() - p2).norm();
}

std::optional<Consensus> estimate_homography(std::span<const PixelPair> pairs,
                                             const ConsensusLimits& limits) {
  constexpr PairModel kModel{
      .sample = kMinHomographyPairs, .fit = fit_homography, .distance = distance_of};
  return find_consensus(kModel, pairs, limits);
}

}  // namespace tsg
