#pragma once

#include <Eigen/Core>
#include <optional>

namespace tsg {

/// Linear equations A f = 0 for the nine elements of a 3x3 matrix, a row each.
using NineColumns = Eigen::Matrix<double, Eigen::Dynamic, 9>;

/// The 3x3 matrix, rows first and of norm 1, whose elements solve A f = 0: exactly for eight rows,
/// in the least squares for more. Nothing where a second solution does as well, as with fewer rows.
[[nodiscard]] std::optional<Eigen::Matrix3d> null_vector(const NineColumns& A);

}  // namespace tsg
