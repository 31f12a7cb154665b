#include "services/slam/lib/surface_prior.hpp"

#include "services/slam/lib/surface_alignment.hpp"

namespace tsg {
namespace {

constexpr double kMinOverlap = 0.5;
constexpr double kMinAgreement = 0.85;  // people without a mask may stand in a tenth of the view

}  // namespace

std::optional<PosePrior> pose_by_surface(const ObservationModel& model,
                                         const FeatureConfig& config,
                                         const TrackedFrame& last,
                                         const Features& features,
                                         const SE3& T_camera_world) {
  const PatchGrid reference(model.camera(), last.features->surface, config);
  const PatchGrid camera(model.camera(), features.surface, config);
  std::optional<SurfaceAlignment> best;
  for (const SE3& T_camera_last : {T_camera_world * last.T_world_camera, SE3()}) {
    const auto alignment = align_surfaces(model, reference, camera, T_camera_last);
    if (!alignment || alignment->overlap < kMinOverlap || alignment->agreement < kMinAgreement) {
      continue;
    }
    if (!best || alignment->agreement > best->agreement) best = alignment;
    if (best->agreement >= kGoodAgreement) break;
  }
  if (!best) return std::nullopt;
  return PosePrior{best->T_camera_reference * last.T_world_camera.inverse(), best->information};
}

}  // namespace tsg
