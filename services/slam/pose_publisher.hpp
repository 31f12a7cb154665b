#pragma once

#include <string>

#include "common/bus/bus.hpp"
#include "common/bus/topics.hpp"
#include "services/slam/odometry.hpp"

namespace tsg {

/// Tells robot software where the camera is: rt/tsg/pose (in `map`), rt/tsg/odom, and rt/tf with
/// map -> odom -> camera. In a part of the map that has no known place in `map`, the frame
/// `map_<part>` stands for it: nobody can take the one for the other.
class PosePublisher {
 public:
  explicit PosePublisher(Bus& bus);

  Expected<void> publish(const OdometryPose& pose, const std::string& map_frame);

 private:
  Expected<void> publish_pose(const OdometryPose& pose, const std::string& map_frame);
  Expected<void> publish_odometry(const OdometryPose& pose);
  Expected<void> publish_transforms(const OdometryPose& pose, const std::string& map_frame);

  Publisher<topics::Pose> pose_;
  Publisher<topics::Odometry> odometry_;
  Publisher<topics::Transforms> transforms_;
};

}  // namespace tsg
