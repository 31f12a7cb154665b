#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace tsg {

using Vector6d = Eigen::Matrix<double, 6, 1>;

/// Rigid transform of 3-D points. `SE3 T_a_b` takes coordinates in b to coordinates in a:
/// p_a = T_a_b * p_b; inner names cancel: T_a_c = T_a_b * T_b_c.
class SE3 {
 public:
  SE3() = default;  ///< identity
  /// `rotation` is normalised.
  // NOLINTNEXTLINE(modernize-pass-by-value): Eigen forbids it for its aligned types
  SE3(const Eigen::Quaterniond& rotation, const Eigen::Vector3d& translation)
      : rotation_(rotation.normalized()), translation_(translation) {}
  SE3(const Eigen::Matrix3d& rotation, const Eigen::Vector3d& translation)
      : SE3(Eigen::Quaterniond(rotation), translation) {}
  /// The very numbers of an SE3 that was taken apart; `rotation` must be of unit length.
  [[nodiscard]] static SE3 of_unit_rotation(const Eigen::Quaterniond& rotation,
                                            const Eigen::Vector3d& translation) {
    SE3 T_a_b;
    T_a_b.rotation_ = rotation;
    T_a_b.translation_ = translation;
    return T_a_b;
  }

  [[nodiscard]] const Eigen::Quaterniond& rotation() const { return rotation_; }
  [[nodiscard]] const Eigen::Vector3d& translation() const { return translation_; }
  [[nodiscard]] Eigen::Matrix3d rotation_matrix() const { return rotation_.toRotationMatrix(); }
  [[nodiscard]] Eigen::Isometry3d to_isometry() const;

  [[nodiscard]] SE3 inverse() const;
  [[nodiscard]] SE3 operator*(const SE3& other) const {
    return {rotation_ * other.rotation_, rotation_ * other.translation_ + translation_};
  }
  [[nodiscard]] Eigen::Vector3d operator*(const Eigen::Vector3d& point) const {
    return rotation_ * point + translation_;
  }

  /// Exponential map of a twist (translation part first, metres; then rotation vector, radians).
  [[nodiscard]] static SE3 exp(const Vector6d& twist);
  /// Inverse of exp(); the rotation vector is at most pi long.
  [[nodiscard]] Vector6d log() const;

  /// False where any number is NaN or infinite.
  [[nodiscard]] bool is_finite() const {
    return rotation_.coeffs().allFinite() && translation_.allFinite();
  }
  /// Angle of the rotation, 0..pi radians.
  [[nodiscard]] double angle() const;

 private:
  Eigen::Quaterniond rotation_ = Eigen::Quaterniond::Identity();
  Eigen::Vector3d translation_ = Eigen::Vector3d::Zero();
};

/// The matrix with skew(a) * b = a x b.
[[nodiscard]] Eigen::Matrix3d skew(const Eigen::Vector3d& vector);

}  // namespace tsg
