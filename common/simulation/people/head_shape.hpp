#pragma once

#include <Eigen/Core>
#include <vector>

namespace tsg::simulation {

/// A level cross-section of the head of a body of 1.75 m, chin at 1.52 m.
struct HeadLevel {
  float z;
  float x;
  float half_width;
  float front;
  float back;
};

/// From the chin to the crown.
[[nodiscard]] const std::vector<HeadLevel>& head_levels();

/// u of a point of the face that is `y_m` left of its middle, at eye height: for painting.
[[nodiscard]] double face_u(double y_m);
/// v of a height.
[[nodiscard]] double face_v(double z_m);

inline constexpr double kFaceTopM = 1.77;
inline constexpr double kFaceHeightM = 0.27;
inline constexpr double kEyeHeightM = 1.637;
inline constexpr double kEyeAsideM = 0.031;
inline constexpr double kMouthHeightM = 1.567;

}  // namespace tsg::simulation
