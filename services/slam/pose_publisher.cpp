#include "services/slam/pose_publisher.hpp"

#include <string>
#include <vector>

#include "common/bus/convert.hpp"

namespace tsg {
namespace {

const std::string kOdomFrame = "odom";
const std::string kCameraFrame = "camera";

geometry_msgs_msg_dds__Vector3_ to_ros_vector(const Eigen::Vector3d& vector) {
  return {.x = vector.x(), .y = vector.y(), .z = vector.z()};
}

geometry_msgs_msg_dds__TransformStamped_ to_ros_stamped(std::int64_t stamp_ns,
                                                        const std::string& frame,
                                                        const std::string& child_frame,
                                                        const SE3& T_frame_child) {
  geometry_msgs_msg_dds__TransformStamped_ message{};
  message.header.stamp = to_ros_time(stamp_ns);
  message.header.frame_id = lend(frame);
  message.child_frame_id = lend(child_frame);
  message.transform = to_ros_transform(T_frame_child);
  return message;
}

}  // namespace

PosePublisher::PosePublisher(Bus& bus) : pose_(bus), odometry_(bus), transforms_(bus) {}

Expected<void> PosePublisher::publish(const OdometryPose& pose, const std::string& map_frame) {
  return publish_pose(pose, map_frame)
      .and_then([&] { return publish_odometry(pose); })
      .and_then([&] { return publish_transforms(pose, map_frame); });
}

Expected<void> PosePublisher::publish_pose(const OdometryPose& pose, const std::string& map_frame) {
  topics::Pose::Message message{};
  message.header.stamp = to_ros_time(pose.stamp_ns);
  message.header.frame_id = lend(map_frame);
  message.pose = to_ros_pose(pose.T_map_camera);
  return pose_.publish(message);
}

Expected<void> PosePublisher::publish_odometry(const OdometryPose& pose) {
  topics::Odometry::Message message{};
  message.header.stamp = to_ros_time(pose.stamp_ns);
  message.header.frame_id = lend(kOdomFrame);
  message.child_frame_id = lend(kCameraFrame);
  message.pose.pose = to_ros_pose(pose.T_odom_camera);
  Eigen::Map<Eigen::Matrix<double, 6, 6, Eigen::RowMajor>>(message.pose.covariance) =
      pose.covariance;
  if (pose.twist_camera) {
    message.twist.twist.linear = to_ros_vector(pose.twist_camera->head<3>());
    message.twist.twist.angular = to_ros_vector(pose.twist_camera->tail<3>());
  }
  return odometry_.publish(message);
}

Expected<void> PosePublisher::publish_transforms(const OdometryPose& pose,
                                                 const std::string& map_frame) {
  const std::vector transforms = {
      to_ros_stamped(pose.stamp_ns, map_frame, kOdomFrame, pose.T_map_odom),
      to_ros_stamped(pose.stamp_ns, kOdomFrame, kCameraFrame, pose.T_odom_camera)};
  topics::Transforms::Message message{};
  lend(transforms, message.transforms);
  return transforms_.publish(message);
}

}  // namespace tsg
