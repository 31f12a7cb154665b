#include "services/slam/lib/frame_matches.hpp"

#include <algorithm>

namespace tsg {

void FrameMatches::drop_unmapped() {
  for (Slot& slot : slots_) {
    if (slot.id == kNoPoint) slot.matched = false;
  }
}

void FrameMatches::drop_unfit(const ObservationModel& model, const SE3& T_camera_world) {
  for (std::size_t i = 0; i < slots_.size(); ++i) {
    if (!slots_[i].matched) continue;
    const Eigen::Vector3d p_camera = T_camera_world * slots_[i].p_world;
    const PointObservation seen = model.observe(features_->items[i]);
    if (p_camera.z() <= 0.0 || !ObservationModel::is_inlier(model.residual(seen, p_camera))) {
      slots_[i] = Slot{};
    }
  }
}

FrameMatches FrameMatches::of_static() const {
  FrameMatches matches = *this;
  for (std::size_t i = 0; i < slots_.size(); ++i) {
    if (features_->items[i].verdict != FeatureVerdict::kStatic) matches.slots_[i] = Slot{};
  }
  return matches;
}

FrameMatches FrameMatches::onto(const Features& left, const std::vector<int>& new_index) const {
  FrameMatches matches(left);
  for (std::size_t i = 0; i < slots_.size(); ++i) {
    if (new_index[i] >= 0) matches.slots_[static_cast<std::size_t>(new_index[i])] = slots_[i];
  }
  return matches;
}

PoseEstimate FrameMatches::optimise(const ObservationModel& model,
                                    const SE3& T_camera_world,
                                    const PosePrior& prior) {
  PoseEstimate estimate = optimise_pose(model, to_point_matches(model), T_camera_world, prior);
  std::size_t match = 0;
  for (Slot& slot : slots_) {
    if (!slot.matched) continue;
    if (!estimate.is_inlier[match++]) slot = Slot{};
  }
  return estimate;
}

std::vector<PointMatch> FrameMatches::to_point_matches(const ObservationModel& model) const {
  std::vector<PointMatch> matches;
  matches.reserve(slots_.size());
  for (std::size_t i = 0; i < slots_.size(); ++i) {
    if (slots_[i].matched) {
      matches.push_back({slots_[i].p_world, model.observe(features_->items[i])});
    }
  }
  return matches;
}

int FrameMatches::count() const {
  return static_cast<int>(
      std::count_if(slots_.begin(), slots_.end(), [](const Slot& slot) { return slot.matched; }));
}

int FrameMatches::mapped() const {
  return static_cast<int>(std::count_if(slots_.begin(), slots_.end(), [](const Slot& slot) {
    return slot.matched && slot.id != kNoPoint;
  }));
}

std::vector<bool> FrameMatches::taken() const {
  std::vector<bool> taken(slots_.size());
  std::transform(slots_.begin(), slots_.end(), taken.begin(),
                 [](const Slot& slot) { return slot.matched; });
  return taken;
}

std::vector<PointId> FrameMatches::points() const {
  std::vector<PointId> points(slots_.size());
  std::transform(slots_.begin(), slots_.end(), points.begin(),
                 [](const Slot& slot) { return slot.matched ? slot.id : kNoPoint; });
  return points;
}

}  // namespace tsg
