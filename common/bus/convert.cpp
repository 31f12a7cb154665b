#include "common/bus/convert.hpp"

#include <cmath>

#include "common/core/time.hpp"

namespace tsg {
namespace {

constexpr std::int64_t kNsPerSecond = 1'000'000'000;

/// The same numbers on the wire and in ROS.
template <typename Quaternion, typename Message>
void copy_quaternion(const Quaternion& from, Message& to) {
  to.x = from.x();
  to.y = from.y();
  to.z = from.z();
  to.w = from.w();
}

template <typename Vector, typename Message>
void copy_vector(const Vector& from, Message& to) {
  to.x = from.x();
  to.y = from.y();
  to.z = from.z();
}

}  // namespace

tsg_CameraIntrinsics to_message(const CameraModel& camera) {
  tsg_CameraIntrinsics message{};
  message.width = static_cast<std::uint32_t>(camera.width);
  message.height = static_cast<std::uint32_t>(camera.height);
  message.fx = camera.fx;
  message.fy = camera.fy;
  message.cx = camera.cx;
  message.cy = camera.cy;
  std::copy(camera.distortion.begin(), camera.distortion.end(), message.distortion);
  return message;
}

CameraModel to_camera(const tsg_CameraIntrinsics& message) {
  CameraModel camera{.width = static_cast<int>(message.width),
                     .height = static_cast<int>(message.height),
                     .fx = message.fx,
                     .fy = message.fy,
                     .cx = message.cx,
                     .cy = message.cy};
  std::copy(std::begin(message.distortion), std::end(message.distortion),
            camera.distortion.begin());
  return camera;
}

tsg_Pose to_message(const SE3& T_a_b) {
  const Eigen::Vector3d& t = T_a_b.translation();
  const Eigen::Quaterniond& q = T_a_b.rotation();
  return {t.x(), t.y(), t.z(), q.x(), q.y(), q.z(), q.w()};
}

Expected<SE3> to_se3(const tsg_Pose& message) {
  const Eigen::Vector3d translation(message.tx, message.ty, message.tz);
  const Eigen::Quaterniond rotation(message.qw, message.qx, message.qy, message.qz);
  constexpr double kNormTolerance = 1e-3;
  // Written so that NaN fails as well.
  const bool is_rotation = std::abs(rotation.norm() - 1.0) < kNormTolerance;
  if (!is_rotation || !translation.allFinite()) {
    return make_error(ExitCode::kInvalidNumber,
                      "a pose on the bus is no rigid transform (NaN, or not a unit quaternion)");
  }
  return SE3(rotation, translation);
}

builtin_interfaces_msg_dds__Time_ to_ros_time(std::int64_t stamp_ns) {
  // Rounded down, so that nanosec is never negative.
  const std::int64_t remainder = ((stamp_ns % kNsPerSecond) + kNsPerSecond) % kNsPerSecond;
  return {static_cast<std::int32_t>((stamp_ns - remainder) / kNsPerSecond),
          static_cast<std::uint32_t>(remainder)};
}

std::int64_t to_ns(const builtin_interfaces_msg_dds__Time_& time) {
  return time.sec * kNsPerSecond + time.nanosec;
}

geometry_msgs_msg_dds__Pose_ to_ros_pose(const SE3& T_a_b) {
  geometry_msgs_msg_dds__Pose_ pose{};
  copy_vector(T_a_b.translation(), pose.position);
  copy_quaternion(T_a_b.rotation(), pose.orientation);
  return pose;
}

geometry_msgs_msg_dds__Transform_ to_ros_transform(const SE3& T_a_b) {
  geometry_msgs_msg_dds__Transform_ transform{};
  copy_vector(T_a_b.translation(), transform.translation);
  copy_quaternion(T_a_b.rotation(), transform.rotation);
  return transform;
}

}  // namespace tsg
