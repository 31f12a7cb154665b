#pragma once

#include "services/slam/lib/frame_matches.hpp"
#include "services/slam/lib/observation_model.hpp"

namespace tsg {

/// Of 16 cells of the image, those that hold a matched feature: many matches in one corner may be
/// a poster that hangs elsewhere too.
[[nodiscard]] int cells_with_matches(const CameraModel& camera, const FrameMatches& matches);

/// Whether two depth images fit each other at that pose: enough of what both see, and in neither
/// direction more than a share `max_contradiction` of it seen through what should be there.
[[nodiscard]] bool do_surfaces_fit(const ObservationModel& model,
                                   const Features& a,
                                   const Features& b,
                                   const SE3& T_b_a,
                                   double max_contradiction);

}  // namespace tsg
