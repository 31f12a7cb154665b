#include "common/simulation/people/head_shape.hpp"

#include <cmath>
#include <numbers>

namespace tsg::simulation {

const std::vector<HeadLevel>& head_levels() {
  static const std::vector<HeadLevel> kLevels{
      {1.520F, 0.052F, 0.022F, 0.030F, 0.030F},  {1.528F, 0.042F, 0.040F, 0.050F, 0.050F},
      {1.542F, 0.028F, 0.052F, 0.069F, 0.065F},  {1.560F, 0.016F, 0.060F, 0.080F, 0.078F},
      {1.580F, 0.010F, 0.066F, 0.086F, 0.090F},  {1.605F, 0.006F, 0.071F, 0.088F, 0.099F},
      {1.637F, 0.004F, 0.075F, 0.089F, 0.106F},  {1.665F, 0.003F, 0.077F, 0.091F, 0.108F},
      {1.695F, 0.000F, 0.075F, 0.087F, 0.104F},  {1.720F, -0.004F, 0.066F, 0.074F, 0.093F},
      {1.738F, -0.008F, 0.050F, 0.053F, 0.070F}, {1.748F, -0.010F, 0.028F, 0.030F, 0.040F}};
  return kLevels;
}

double face_u(double y_m) {
  constexpr double kHalfWidthM = 0.075;
  return 0.5 + std::asin(y_m / kHalfWidthM) / (2.0 * std::numbers::pi);
}

double face_v(double z_m) { return (kFaceTopM - z_m) / kFaceHeightM; }

}  // namespace tsg::simulation
