#include "services/slam/lib/dynamic/fundamental_matrix.hpp"

#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <limits>

#include "services/slam/lib/dynamic/null_vector.hpp"

namespace tsg {
namespace {

/// Eq. 4, a row for each pair.
NineColumns epipolar_equations(std::span<const PixelPair> pairs,
                               const Normalisation& to_normalised) {
  NineColumns rows(static_cast<Eigen::Index>(pairs.size()), 9);
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const Eigen::Vector3d p1 = to_normalised.N1 * pairs[i].p1.homogeneous();
    const Eigen::Vector3d p2 = to_normalised.N2 * pairs[i].p2.homogeneous();
    rows.row(static_cast<Eigen::Index>(i)) << p2.x() * p1.transpose(), p2.y() * p1.transpose(),
        p1.transpose();
  }
  return rows;
}

Eigen::Matrix3d nearest_of_rank_2(const Eigen::Matrix3d& F) {
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(F, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Vector3d values = svd.singularValues();
  values[2] = 0.0;
  return svd.matrixU() * values.asDiagonal() * svd.matrixV().transpose();
}

double distance_in_both(const Eigen::Matrix3d& F, const PixelPair& pair) {
  const Eigen::Vector3d line2 = F * pair.p1.homogeneous();
  const Eigen::Vector3d line1 = F.transpose() * pair.p2.homogeneous();
  const double nearest_epipole =
      std::min(line1.head<2>().squaredNorm(), line2.head<2>().squaredNorm());
  return std::abs(pair.p2.homogeneous().dot(line2)) / std::sqrt(nearest_epipole);
}

}  // namespace

std::optional<Eigen::Matrix3d> eight_point(std::span<const PixelPair> pairs) {
  if (pairs.size() < kMinFundamentalPairs) return std::nullopt;
  const Normalisation to_normalised(pairs);
  const auto F_normalised = null_vector(epipolar_equations(pairs, to_normalised));
  if (!F_normalised) return std::nullopt;
  const Eigen::Matrix3d F =
      to_normalised.N2.transpose() * nearest_of_rank_2(*F_normalised) * to_normalised.N1;
  return F.normalized();
}

double epipolar_distance(const Eigen::Matrix3d& F,
                         const Eigen::Vector2d& p1,
                         const Eigen::Vector2d& p2) {
  const Eigen::Vector3d line = F * p1.homogeneous();
  const double norm = line.head<2>().norm();
  if (norm == 0.0) return std::numeric_limits<double>::infinity();
  return std::abs(p2.homogeneous().dot(line)) / norm;
}

std::optional<Consensus> estimate_fundamental(std::span<const PixelPair> pairs,
                                              const ConsensusLimits& limits) {
  constexpr PairModel kModel{
      .sample = kMinFundamentalPairs, .fit = eight_point, .distance = distance_in_both};
  return find_consensus(kModel, pairs, limits);
}

}  // namespace tsg
