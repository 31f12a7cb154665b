#pragma once

// An example of every message type on the bus, without two equal numbers where a mix-up could hide.

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "common/bus/messages.hpp"

namespace tsg::test {

inline constexpr std::size_t kVgaPixels = std::size_t{640} * 480;

/// Text that lives as long as the program.
inline char* text(const char* literal) {
  return const_cast<char*>(literal);  // NOLINT(*-const-cast): publish() only reads
}

inline std_msgs_msg_dds__Header_ ros_header(const char* frame) {
  return {.stamp = {.sec = 1305031102, .nanosec = 175304000}, .frame_id = text(frame)};
}

inline geometry_msgs_msg_dds__Pose_ ros_pose() {
  return {.position = {1.5, -2.5, 3.5}, .orientation = {0.1, 0.2, 0.3, 0.9}};
}

inline tsg_Header header() {
  return {.seq = 17, .stamp_ns = 1305031102175304000, .publish_monotonic_ns = 99};
}

inline void fill_example(tsg_RgbdFrame& message) {
  message.header = header();
  message.intrinsics = {640, 480, 517.3, 516.5, 318.6, 255.3, {0.1, 0.2, 0.3, 0.4, 0.5}};
  message.depth_units_per_metre = 5000.0;
  for (std::size_t i = 0; i < kVgaPixels; ++i) message.depth[i] = static_cast<std::uint16_t>(i);
  for (std::size_t i = 0; i < 3 * kVgaPixels; ++i) message.colour[i] = static_cast<std::uint8_t>(i);
}

inline void fill_example(tsg_InstanceMask& message) {
  message.header = header();
  message.width = 640;
  message.height = 480;
  message.instance_count = 1;
  message.instances[0] = {"person", 0.75F, 1.0F, 2.0F, 30.0F, 40.0F, tsg_MOTION_MOVING, 77};
  std::string("yolo").copy(message.model_name, sizeof(message.model_name) - 1);
  message.inference_ns = 123;
  message.input_age_ns = 45;
  std::fill(message.labels, message.labels + 1000, std::uint8_t{1});
}

inline void fill_example(tsg_Keyframe& message) {
  message.header = header();
  message.frame_seq = 170;
  message.id = 5;
  message.T_world_camera = {1.0, 2.0, 3.0, 0.1, 0.2, 0.3, 0.9};
  message.intrinsics = {640, 480, 517.3, 516.5, 318.6, 255.3, {0.1, 0.2, 0.3, 0.4, 0.5}};
  message.depth_units_per_metre = 5000.0;
  message.has_labels = true;
  message.instance_count = 1;
  message.instances[0] = {"chair", 0.5F, 1.0F, 2.0F, 30.0F, 40.0F, tsg_MOTION_STATIC, 78};
  std::fill(message.labels, message.labels + 1000, std::uint8_t{1});
  std::fill(message.depth, message.depth + 5000, std::uint16_t{7000});
}

inline void fill_example(tsg_TrackingStatus& message) {
  message.header = header();
  message.state = tsg_TRACKING_LOST;
  std::string("too few matches").copy(message.reason, sizeof(message.reason) - 1);
  message.features = 1000;
  message.inliers = 9;
  message.mask_age_frames = -1;
  message.frames_dropped = 3;
  message.latency_ns = 12'000'000;
}

inline void fill_example(tsg_KeyframePoses& message) {
  static const std::vector<tsg_KeyframePose> kPoses{
      {.id = 1, .stamp_ns = 11, .T_world_camera = {1, 2, 3, 0, 0, 0, 1}},
      {.id = 2, .stamp_ns = 22, .T_world_camera = {4, 5, 6, 0, 0, 1, 0}}};
  message.header = header();
  lend(kPoses, message.keyframes);
}

inline void fill_example(tsg_CompressedColour& message) {
  static const std::vector<std::uint8_t> kBytes{0xFF, 0xD8, 7, 0};
  message.header = header();
  message.width = 640;
  message.height = 480;
  lend(kBytes, message.jpeg);
}

inline void fill_example(tsg_CompressedMask& message) {
  static const std::vector<std::uint8_t> kBytes{0x89, 'P', 'N', 'G', 0};
  static const std::vector<tsg_Instance> kInstances{
      {"person", 0.75F, 1.0F, 2.0F, 30.0F, 40.0F, tsg_MOTION_UNKNOWN, 77},
      {"chair", 0.5F, 3.0F, 4.0F, 50.0F, 60.0F, tsg_MOTION_UNKNOWN, 78}};
  message.header = header();
  message.width = 640;
  message.height = 480;
  std::string("solo").copy(message.model_name, sizeof(message.model_name) - 1);
  message.inference_ns = 321;
  lend(kInstances, message.instances);
  lend(kBytes, message.labels);
}

inline void fill_example(tsg_Command& message) {
  message = {.id = 42,
             .service = text("slam"),
             .verb = text("save_trajectory"),
             .argument = text(R"({"folder":"/tmp"})")};
}

inline void fill_example(tsg_Reply& message) {
  message = {
      .id = 42, .service = text("slam"), .ok = false, .exit_code = 73, .text = text("disk full")};
}

inline void fill_example(geometry_msgs_msg_dds__PoseStamped_& message) {
  message = {.header = ros_header("map"), .pose = ros_pose()};
}

inline void fill_example(nav_msgs_msg_dds__Odometry_& message) {
  message.header = ros_header("odom");
  message.child_frame_id = text("camera");
  message.pose.pose = ros_pose();
  message.pose.covariance[7] = 0.25;
  message.twist.twist = {.linear = {0.5, 0.6, 0.7}, .angular = {0.8, 0.9, 1.1}};
  message.twist.covariance[35] = 0.125;
}

inline void fill_example(tf2_msgs_msg_dds__TFMessage_& message) {
  static const std::vector<geometry_msgs_msg_dds__TransformStamped_> kTransforms{
      {.header = ros_header("map"),
       .child_frame_id = text("odom"),
       .transform = {.translation = {1, 2, 3}, .rotation = {0, 0, 0, 1}}},
      {.header = ros_header("odom"),
       .child_frame_id = text("camera"),
       .transform = {.translation = {4, 5, 6}, .rotation = {0, 1, 0, 0}}}};
  lend(kTransforms, message.transforms);
}

inline void fill_example(octomap_msgs_msg_dds__Octomap_& message) {
  static const std::vector<std::int8_t> kData(3000, std::int8_t{-5});
  message.header = ros_header("map");
  message.binary = false;
  message.id = text("ColorOcTree");
  message.resolution = 0.05;
  lend(kData, message.data);
}

inline void fill_example(vision_msgs_msg_dds__Detection3DArray_& message) {
  static const std::vector<vision_msgs_msg_dds__ObjectHypothesisWithPose_> kResults{
      {.hypothesis = {.class_id = text("chair"), .score = 0.8},
       .pose = {.pose = ros_pose(), .covariance = {}}}};
  static std::vector<vision_msgs_msg_dds__Detection3D_> detections(1);
  detections[0].header = ros_header("map");
  lend(kResults, detections[0].results);
  detections[0].bbox = {.center = ros_pose(), .size = {0.5, 0.6, 0.7}};
  detections[0].id = text("chair 3");
  message.header = ros_header("map");
  lend(detections, message.detections);
}

/// Five megabytes: many network packets.
inline void fill_example(sensor_msgs_msg_dds__PointCloud2_& message) {
  static const std::vector<std::uint8_t> kData(5'000'000, std::uint8_t{3});
  static const std::vector<sensor_msgs_msg_dds__PointField_> kFields{
      {.name = text("x"), .offset = 0, .datatype = 7, .count = 1},
      {.name = text("rgb"), .offset = 12, .datatype = 6, .count = 1}};
  message.header = ros_header("map");
  message.height = 1;
  message.width = 312'500;
  lend(kFields, message.fields);
  message.point_step = 16;
  message.row_step = 5'000'000;
  lend(kData, message.data);
  message.is_dense = true;
}

inline void fill_example(nav_msgs_msg_dds__OccupancyGrid_& message) {
  static const std::vector<std::int8_t> kCells{0, 100, -1, 50, 0, 0};
  message.header = ros_header("map");
  message.info = {.map_load_time = {.sec = 1, .nanosec = 2},
                  .resolution = 0.05F,
                  .width = 3,
                  .height = 2,
                  .origin = ros_pose()};
  lend(kCells, message.data);
}

inline void fill_example(diagnostic_msgs_msg_dds__DiagnosticArray_& message) {
  static const std::vector<diagnostic_msgs_msg_dds__KeyValue_> kValues{
      {.key = text("rate_hz"), .value = text("29.9")}};
  static std::vector<diagnostic_msgs_msg_dds__DiagnosticStatus_> statuses(1);
  statuses[0].level = 1;
  statuses[0].name = text("slam");
  statuses[0].message = text("late");
  statuses[0].hardware_id = text("robot");
  lend(kValues, statuses[0].values);
  message.header = ros_header("");
  lend(statuses, message.status);
}

}  // namespace tsg::test
