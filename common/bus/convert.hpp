#pragma once

// Between what is on the wire and the plain structs that libraries speak.

#include <cstdint>

#include "common/bus/messages.hpp"
#include "common/core/error.hpp"
#include "common/geometry/se3.hpp"
#include "common/rgbd/instances.hpp"
#include "common/rgbd/rgbd_frame.hpp"

namespace tsg {

/// The frame in `message` without copying a pixel: valid as long as the message. kBadData where
/// its sizes or intrinsics make no sense.
[[nodiscard]] Expected<RgbdFrame> view_as_frame(const tsg_RgbdFrame& message);
/// The frame that a keyframe was made of; seq is the frame's, not the keyframe's.
[[nodiscard]] Expected<RgbdFrame> view_as_frame(const tsg_Keyframe& message);

/// Fills the whole message, publish_monotonic_ns with the present. kSizeMismatch where the images
/// are not of the camera's size or type, or larger than the wire type has room for.
[[nodiscard]] Expected<void> fill_message(const RgbdFrame& frame, tsg_RgbdFrame& message);
/// Fills all that is about the frame, publish_monotonic_ns included; leaves the keyframe's own
/// header.seq, id and pose, and says that there are no labels (fill those after).
[[nodiscard]] Expected<void> fill_message(const RgbdFrame& frame, tsg_Keyframe& message);

/// The instances of `message`; labels are a view, valid as long as the message. kBadData where
/// sizes make no sense or a label has no instance.
[[nodiscard]] Expected<InstanceSegmentation> view_as_instances(const tsg_InstanceMask& message);
/// The same of a keyframe; without labels (has_labels) an empty cv::Mat and no instances.
[[nodiscard]] Expected<InstanceSegmentation> view_as_instances(const tsg_Keyframe& message);

/// Fills all but model_name, inference_ns and input_age_ns. kSizeMismatch where labels are not
/// CV_8UC1 or larger than the wire type has room for; kBadData for too many instances or too long a
/// name.
[[nodiscard]] Expected<void> fill_message(const InstanceSegmentation& segmentation,
                                          tsg_InstanceMask& message);
/// Fills the labels and instances of a keyframe that already has its frame, of the same size.
[[nodiscard]] Expected<void> fill_message(const InstanceSegmentation& segmentation,
                                          tsg_Keyframe& message);

[[nodiscard]] Instance to_instance(const tsg_Instance& message);
/// kBadData for too long a name.
[[nodiscard]] Expected<tsg_Instance> to_message(const Instance& instance);

[[nodiscard]] tsg_CameraIntrinsics to_message(const CameraModel& camera);
[[nodiscard]] CameraModel to_camera(const tsg_CameraIntrinsics& message);

[[nodiscard]] tsg_Pose to_message(const SE3& T_a_b);
/// kInvalidNumber where the pose holds NaN, infinity or a quaternion that is no rotation.
[[nodiscard]] Expected<SE3> to_se3(const tsg_Pose& message);

[[nodiscard]] builtin_interfaces_msg_dds__Time_ to_ros_time(std::int64_t stamp_ns);
[[nodiscard]] std::int64_t to_ns(const builtin_interfaces_msg_dds__Time_& time);
[[nodiscard]] geometry_msgs_msg_dds__Pose_ to_ros_pose(const SE3& T_a_b);
[[nodiscard]] geometry_msgs_msg_dds__Transform_ to_ros_transform(const SE3& T_a_b);

}  // namespace tsg
