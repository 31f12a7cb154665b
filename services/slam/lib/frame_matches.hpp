#pragma once

#include <Eigen/Core>
#include <vector>

#include "services/slam/lib/features.hpp"
#include "services/slam/lib/ids.hpp"
#include "services/slam/lib/pose_optimizer.hpp"

namespace tsg {

/// Which point each feature of a frame shows.
class FrameMatches {
 public:
  explicit FrameMatches(const Features& features) : features_(&features), slots_(features.size()) {}

  /// `id` may be kNoPoint for a point that is not in the map.
  void assign(int feature, PointId id, const Eigen::Vector3d& p_world) {
    slots_[static_cast<std::size_t>(feature)] = {true, id, p_world};
  }
  /// Drops matches to points that are not in the map.
  void drop_unmapped();
  /// Drops those that do not fit the pose.
  void drop_unfit(const ObservationModel& model, const SE3& T_camera_world);
  /// Those of features of static classes.
  [[nodiscard]] FrameMatches of_static() const;

  /// The same matches of the features that are left of these: `new_index` has for each feature its
  /// place in `left`, or -1.
  [[nodiscard]] FrameMatches onto(const Features& left, const std::vector<int>& new_index) const;

  /// The pose by all matches, from `T_camera_world` on; matches that do not fit it are dropped.
  PoseEstimate optimise(const ObservationModel& model,
                        const SE3& T_camera_world,
                        const PosePrior& prior = {});

  /// The matches in the form that solvers want.
  [[nodiscard]] std::vector<PointMatch> to_point_matches(const ObservationModel& model) const;

  [[nodiscard]] const Features& features() const { return *features_; }
  [[nodiscard]] int count() const;
  [[nodiscard]] int mapped() const;                   ///< matches to points of the map
  [[nodiscard]] std::vector<bool> taken() const;      ///< per feature
  [[nodiscard]] std::vector<PointId> points() const;  ///< per feature, or kNoPoint

 private:
  struct Slot {
    bool matched = false;
    PointId id = kNoPoint;
    Eigen::Vector3d p_world = Eigen::Vector3d::Zero();
  };
  const Features* features_;
  std::vector<Slot> slots_;
};

}  // namespace tsg
