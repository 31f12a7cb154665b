#include "services/slam/lib/dynamic/null_vector.hpp"

#include <Eigen/QR>
#include <Eigen/SVD>
#include <cmath>

namespace tsg {
namespace {

using Vector9 = Eigen::Matrix<double, 9, 1>;

constexpr double kMinRatio = 1e-9;  // of the least to the greatest; below it rounding decides

/// Orthogonal to all rows. A tenth of the time that the singular values take; random samples need
/// hundreds of these.
std::optional<Vector9> exact_solution(const NineColumns& A) {
  const Eigen::ColPivHouseholderQR<Eigen::Matrix<double, 9, 8>> qr(A.transpose());
  const auto diagonal = qr.matrixQR().diagonal();
  if (!(std::abs(diagonal[7]) >= kMinRatio * std::abs(diagonal[0]))) return std::nullopt;
  return Vector9(qr.householderQ() * Vector9::Unit(8));
}

std::optional<Vector9> least_squares_solution(const NineColumns& A) {
  const Eigen::JacobiSVD<NineColumns> svd(A, Eigen::ComputeFullV);
  const auto& values = svd.singularValues();
  if (values[7] < kMinRatio * values[0]) return std::nullopt;
  return Vector9(svd.matrixV().col(8));
}

}  // namespace

std::optional<Eigen::Matrix3d> null_vector(const NineColumns& A) {
  if (A.rows() < 8 || !A.allFinite()) return std::nullopt;
  const auto f = A.rows() == 8 ? exact_solution(A) : least_squares_solution(A);
  if (!f) return std::nullopt;
  return Eigen::Matrix3d(f->reshaped<Eigen::RowMajor>(3, 3));
}

}  // namespace tsg
