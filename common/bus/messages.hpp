#pragma once

// The generated C types of everything on the bus, and what C++ needs to know of them.

#include <cstdint>
#include <span>
#include <string>
#include <vector>

extern "C" {
#include "ros2/diagnostic_msgs.h"
#include "ros2/geometry_msgs.h"
#include "ros2/nav_msgs.h"
#include "ros2/octomap_msgs.h"
#include "ros2/sensor_msgs.h"
#include "ros2/tf2_msgs.h"
#include "ros2/vision_msgs.h"
#include "tsg/command.h"
#include "tsg/instance_mask.h"
#include "tsg/keyframe.h"
#include "tsg/keyframe_poses.h"
#include "tsg/remote_segmentation.h"
#include "tsg/rgbd_frame.h"
#include "tsg/tracking_status.h"
}

namespace tsg {

/// The DDS descriptor of a message type. Specialised for every type that a topic may have.
template <typename Message>
[[nodiscard]] const dds_topic_descriptor_t& descriptor();

// clang-format off
template <> inline const dds_topic_descriptor_t& descriptor<tsg_RgbdFrame>() { return tsg_RgbdFrame_desc; }
template <> inline const dds_topic_descriptor_t& descriptor<tsg_InstanceMask>() { return tsg_InstanceMask_desc; }
template <> inline const dds_topic_descriptor_t& descriptor<tsg_Keyframe>() { return tsg_Keyframe_desc; }
template <> inline const dds_topic_descriptor_t& descriptor<tsg_TrackingStatus>() { return tsg_TrackingStatus_desc; }
template <> inline const dds_topic_descriptor_t& descriptor<tsg_KeyframePoses>() { return tsg_KeyframePoses_desc; }
template <> inline const dds_topic_descriptor_t& descriptor<tsg_CompressedColour>() { return tsg_CompressedColour_desc; }
template <> inline const dds_topic_descriptor_t& descriptor<tsg_CompressedMask>() { return tsg_CompressedMask_desc; }
template <> inline const dds_topic_descriptor_t& descriptor<tsg_Command>() { return tsg_Command_desc; }
template <> inline const dds_topic_descriptor_t& descriptor<tsg_Reply>() { return tsg_Reply_desc; }
template <> inline const dds_topic_descriptor_t& descriptor<geometry_msgs_msg_dds__PoseStamped_>() { return geometry_msgs_msg_dds__PoseStamped__desc; }
template <> inline const dds_topic_descriptor_t& descriptor<nav_msgs_msg_dds__Odometry_>() { return nav_msgs_msg_dds__Odometry__desc; }
template <> inline const dds_topic_descriptor_t& descriptor<nav_msgs_msg_dds__OccupancyGrid_>() { return nav_msgs_msg_dds__OccupancyGrid__desc; }
template <> inline const dds_topic_descriptor_t& descriptor<tf2_msgs_msg_dds__TFMessage_>() { return tf2_msgs_msg_dds__TFMessage__desc; }
template <> inline const dds_topic_descriptor_t& descriptor<octomap_msgs_msg_dds__Octomap_>() { return octomap_msgs_msg_dds__Octomap__desc; }
template <> inline const dds_topic_descriptor_t& descriptor<vision_msgs_msg_dds__Detection3DArray_>() { return vision_msgs_msg_dds__Detection3DArray__desc; }
template <> inline const dds_topic_descriptor_t& descriptor<sensor_msgs_msg_dds__PointCloud2_>() { return sensor_msgs_msg_dds__PointCloud2__desc; }
template <> inline const dds_topic_descriptor_t& descriptor<diagnostic_msgs_msg_dds__DiagnosticArray_>() { return diagnostic_msgs_msg_dds__DiagnosticArray__desc; }
// clang-format on

/// A C string of a message that is only lent to it for publishing; `text` must outlive the message.
[[nodiscard]] inline char* lend(const std::string& text) {
  return const_cast<char*>(text.c_str());  // NOLINT(*-const-cast): publish() only reads
}

/// Points `sequence` at the elements of `values`, which must outlive the message:
///   lend(elements, message.transforms);
template <typename Element, typename Sequence>
void lend(const std::vector<Element>& values, Sequence& sequence) {
  // NOLINTNEXTLINE(*-const-cast): publish() only reads
  sequence._buffer = const_cast<Element*>(values.data());
  sequence._length = static_cast<std::uint32_t>(values.size());
  sequence._maximum = sequence._length;
  sequence._release = false;
}

/// The elements of a received sequence.
template <typename Sequence>
[[nodiscard]] auto elements(const Sequence& sequence) {
  return std::span(sequence._buffer, sequence._length);
}

}  // namespace tsg
