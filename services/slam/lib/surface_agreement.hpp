#pragma once

#include "common/geometry/camera_model.hpp"
#include "common/geometry/se3.hpp"
#include "services/slam/lib/surface.hpp"

namespace tsg {

/// How what one depth image shows fits another's, by number of cells.
struct SurfaceAgreement {
  int cells = 0;         ///< looked at in the first image, whatever they hold
  int agreeing = 0;      ///< both see the surface at the same place
  int seen_through = 0;  ///< the other sees what lies behind: the surface cannot be there
  int hidden = 0;        ///< the other sees something in front: says nothing

  /// Of the cells that say something, the part that contradicts; 1 where none says anything.
  [[nodiscard]] double contradiction() const {
    const int telling = agreeing + seen_through;
    return telling > 0 ? static_cast<double>(seen_through) / telling : 1.0;
  }
};

/// Lays the surface seen by camera a into the view of camera b. `sigma` is the standard deviation
/// of inverse depth, 1/m.
[[nodiscard]] SurfaceAgreement compare_surfaces(const CameraModel& camera,
                                                const Surface& seen_by_a,
                                                const Surface& seen_by_b,
                                                const SE3& T_b_a,
                                                double sigma);

}  // namespace tsg
