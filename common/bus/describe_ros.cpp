#include <cstdint>
#include <numeric>
#include <span>

#include "common/bus/describe.hpp"

namespace tsg {
namespace {

using nlohmann::json;

json describe_header(const std_msgs_msg_dds__Header_& header) {
  return {{"stamp", {{"sec", header.stamp.sec}, {"nanosec", header.stamp.nanosec}}},
          {"frame_id", header.frame_id}};
}

/// Of Point and Vector3.
template <typename Vector>
json describe_vector(const Vector& vector) {
  return {{"x", vector.x}, {"y", vector.y}, {"z", vector.z}};
}

json describe_quaternion(const geometry_msgs_msg_dds__Quaternion_& q) {
  return {{"x", q.x}, {"y", q.y}, {"z", q.z}, {"w", q.w}};
}

json describe_pose(const geometry_msgs_msg_dds__Pose_& pose) {
  return {{"position", describe_vector(pose.position)},
          {"orientation", describe_quaternion(pose.orientation)}};
}

json describe_twist(const geometry_msgs_msg_dds__Twist_& twist) {
  return {{"linear", describe_vector(twist.linear)}, {"angular", describe_vector(twist.angular)}};
}

template <typename Sequence>
json describe_bulk(const Sequence& sequence) {
  const auto values = elements(sequence);
  const double sum = std::accumulate(values.begin(), values.end(), 0.0);
  const json mean = values.empty() ? json() : json(sum / static_cast<double>(values.size()));
  return {{"bytes", values.size()}, {"mean", mean}};
}

json describe_detection(const vision_msgs_msg_dds__Detection3D_& detection) {
  json results = json::array();
  for (const auto& result : elements(detection.results)) {
    results.push_back({{"class_id", result.hypothesis.class_id},
                       {"score", result.hypothesis.score},
                       {"pose", describe_pose(result.pose.pose)}});
  }
  return {{"header", describe_header(detection.header)},
          {"id", detection.id},
          {"results", results},
          {"bbox",
           {{"center", describe_pose(detection.bbox.center)},
            {"size", describe_vector(detection.bbox.size)}}}};
}

json describe_status(const diagnostic_msgs_msg_dds__DiagnosticStatus_& status) {
  json values = json::object();
  for (const auto& value : elements(status.values)) values[value.key] = value.value;
  return {{"level", status.level},
          {"name", status.name},
          {"message", status.message},
          {"hardware_id", status.hardware_id},
          {"values", values}};
}

}  // namespace

json to_json(const geometry_msgs_msg_dds__PoseStamped_& message) {
  return {{"header", describe_header(message.header)}, {"pose", describe_pose(message.pose)}};
}

json to_json(const nav_msgs_msg_dds__Odometry_& message) {
  return {
      {"header", describe_header(message.header)},
      {"child_frame_id", message.child_frame_id},
      {"pose",
       {{"pose", describe_pose(message.pose.pose)}, {"covariance", message.pose.covariance}}},
      {"twist",
       {{"twist", describe_twist(message.twist.twist)}, {"covariance", message.twist.covariance}}}};
}

json to_json(const nav_msgs_msg_dds__OccupancyGrid_& message) {
  return {{"header", describe_header(message.header)},
          {"resolution", message.info.resolution},
          {"width", message.info.width},
          {"height", message.info.height},
          {"origin", describe_pose(message.info.origin)},
          {"data", describe_bulk(message.data)}};
}

json to_json(const tf2_msgs_msg_dds__TFMessage_& message) {
  json transforms = json::array();
  for (const auto& transform : elements(message.transforms)) {
    transforms.push_back({{"header", describe_header(transform.header)},
                          {"child_frame_id", transform.child_frame_id},
                          {"translation", describe_vector(transform.transform.translation)},
                          {"rotation", describe_quaternion(transform.transform.rotation)}});
  }
  return {{"transforms", transforms}};
}

json to_json(const octomap_msgs_msg_dds__Octomap_& message) {
  return {{"header", describe_header(message.header)},
          {"binary", message.binary},
          {"id", message.id},
          {"resolution", message.resolution},
          {"data", describe_bulk(message.data)}};
}

json to_json(const vision_msgs_msg_dds__Detection3DArray_& message) {
  json detections = json::array();
  for (const auto& detection : elements(message.detections)) {
    detections.push_back(describe_detection(detection));
  }
  return {{"header", describe_header(message.header)}, {"detections", detections}};
}

json to_json(const sensor_msgs_msg_dds__PointCloud2_& message) {
  json fields = json::array();
  for (const auto& field : elements(message.fields)) {
    fields.push_back({{"name", field.name},
                      {"offset", field.offset},
                      {"datatype", field.datatype},
                      {"count", field.count}});
  }
  return {{"header", describe_header(message.header)},
          {"height", message.height},
          {"width", message.width},
          {"fields", fields},
          {"is_bigendian", message.is_bigendian},
          {"point_step", message.point_step},
          {"row_step", message.row_step},
          {"data", describe_bulk(message.data)},
          {"is_dense", message.is_dense}};
}

json to_json(const diagnostic_msgs_msg_dds__DiagnosticArray_& message) {
  json statuses = json::array();
  for (const auto& status : elements(message.status)) statuses.push_back(describe_status(status));
  return {{"header", describe_header(message.header)}, {"status", statuses}};
}

}  // namespace tsg
