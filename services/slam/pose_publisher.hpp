#pragma once

#include "common/bus/bus.hpp"
#include "common/bus/topics.hpp"
#include "services/slam/odometry.hpp"

namespace tsg {

/// Tells robot software where the camera is: rt/tsg/pose (in `map`), rt/tsg/odom, and rt/tf with
/// map -> odom -> camera.
class PosePublisher {
 public:
  explicit PosePublisher(Bus& bus);

  Expected<void> publish(const OdometryPose& pose);

 private:
  Expected<void> publish_pose(const OdometryPose& pose);
  Expected<void> publish_odometry(const OdometryPose& pose);
  Expected<void> publish_transforms(const OdometryPose& pose);

  Publisher<topics::Pose> pose_;
  Publisher<topics::Odometry> odometry_;
  Publisher<topics::Transforms> transforms_;
};

}  // namespace tsg
