#include <algorithm>
#include <array>
#include <span>
#include <string>

#include "common/bus/describe.hpp"
#include "common/bus/field_text.hpp"

namespace tsg {
namespace {

using nlohmann::json;

template <typename Value>
json mean_of(std::span<const Value> values) {
  if (values.empty()) return nullptr;
  double sum = 0.0;
  for (const Value value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

/// Pixels in use; never more than there is room for, whatever the message says.
std::size_t pixel_count(std::uint64_t width, std::uint64_t height) {
  return std::min<std::size_t>(width * height, tsg_MAX_PIXELS);
}

json describe_header(const tsg_Header& header) {
  return {{"seq", header.seq},
          {"stamp_ns", header.stamp_ns},
          {"publish_monotonic_ns", header.publish_monotonic_ns}};
}

json describe_intrinsics(const tsg_CameraIntrinsics& camera) {
  return {{"width", camera.width},
          {"height", camera.height},
          {"fx", camera.fx},
          {"fy", camera.fy},
          {"cx", camera.cx},
          {"cy", camera.cy},
          {"distortion", camera.distortion}};
}

json describe_pose(const tsg_Pose& pose) {
  return {{"t", {pose.tx, pose.ty, pose.tz}}, {"q_xyzw", {pose.qx, pose.qy, pose.qz, pose.qw}}};
}

const char* motion_name(tsg_MotionVerdict motion) {
  constexpr std::array kNames{"unknown", "static", "moving"};
  const auto index = static_cast<std::size_t>(motion);
  return index < kNames.size() ? kNames.at(index) : "invalid";
}

const char* state_name(tsg_TrackingState state) {
  constexpr std::array kNames{"initialising", "ok", "lost", "relocalising"};
  const auto index = static_cast<std::size_t>(state);
  return index < kNames.size() ? kNames.at(index) : "invalid";
}

json describe_each(std::span<const tsg_Instance> instances) {
  json all = json::array();
  for (const tsg_Instance& instance : instances) {
    all.push_back(
        {{"class", text_of(instance.class_name)},
         {"score", instance.score},
         {"box", {instance.box_min_x, instance.box_min_y, instance.box_max_x, instance.box_max_y}},
         {"motion", motion_name(instance.motion)},
         {"track_id", instance.track_id}});
  }
  return all;
}

/// Of InstanceMask and Keyframe.
template <typename Message>
json describe_instances(const Message& message) {
  const auto count = std::min<std::uint32_t>(message.instance_count, tsg_MAX_INSTANCES);
  return describe_each(std::span(message.instances).first(count));
}

json describe_labels(std::span<const std::uint8_t> labels) {
  const auto labelled =
      std::count_if(labels.begin(), labels.end(), [](std::uint8_t label) { return label != 0; });
  return {{"pixels", labels.size()}, {"labelled", labelled}};
}

/// Of RgbdFrame and Keyframe: depth in metres over the pixels that have one.
template <typename Message>
void describe_images(const Message& message, json& result) {
  const std::size_t pixels = pixel_count(message.intrinsics.width, message.intrinsics.height);
  const auto depth = std::span(message.depth).first(pixels);
  std::size_t valid = 0;
  double sum = 0.0;
  for (const std::uint16_t raw : depth) {
    sum += raw;
    valid += raw != 0 ? 1 : 0;
  }
  const double mean = valid == 0 ? 0.0 : sum / static_cast<double>(valid);
  result["colour"] = {{"bytes", 3 * pixels},
                      {"mean", mean_of(std::span(message.colour).first(3 * pixels))}};
  result["depth"] = {
      {"pixels", pixels}, {"valid", valid}, {"mean_m", mean / message.depth_units_per_metre}};
}

}  // namespace

json to_json(const tsg_RgbdFrame& message) {
  json result = {{"header", describe_header(message.header)},
                 {"intrinsics", describe_intrinsics(message.intrinsics)},
                 {"depth_units_per_metre", message.depth_units_per_metre}};
  describe_images(message, result);
  return result;
}

json to_json(const tsg_InstanceMask& message) {
  const std::size_t pixels = pixel_count(message.width, message.height);
  return {{"header", describe_header(message.header)},
          {"width", message.width},
          {"height", message.height},
          {"instances", describe_instances(message)},
          {"model_name", text_of(message.model_name)},
          {"inference_ns", message.inference_ns},
          {"input_age_ns", message.input_age_ns},
          {"labels", describe_labels(std::span(message.labels).first(pixels))}};
}

json to_json(const tsg_Keyframe& message) {
  const std::size_t pixels = pixel_count(message.intrinsics.width, message.intrinsics.height);
  json result = {{"header", describe_header(message.header)},
                 {"frame_seq", message.frame_seq},
                 {"id", message.id},
                 {"T_world_camera", describe_pose(message.T_world_camera)},
                 {"intrinsics", describe_intrinsics(message.intrinsics)},
                 {"depth_units_per_metre", message.depth_units_per_metre},
                 {"has_labels", message.has_labels},
                 {"instances", describe_instances(message)}};
  describe_images(message, result);
  if (message.has_labels) {
    result["labels"] = describe_labels(std::span(message.labels).first(pixels));
  }
  return result;
}

json to_json(const tsg_TrackingStatus& message) {
  return {{"header", describe_header(message.header)},
          {"state", state_name(message.state)},
          {"reason", text_of(message.reason)},
          {"features", message.features},
          {"features_static", message.features_static},
          {"features_dynamic", message.features_dynamic},
          {"matches", message.matches},
          {"inliers", message.inliers},
          {"keyframes", message.keyframes},
          {"map_points", message.map_points},
          {"mask_age_frames", message.mask_age_frames},
          {"frames_dropped", message.frames_dropped},
          {"extract_ns", message.extract_ns},
          {"match_ns", message.match_ns},
          {"optimise_ns", message.optimise_ns},
          {"total_ns", message.total_ns},
          {"latency_ns", message.latency_ns}};
}

json to_json(const tsg_KeyframePoses& message) {
  json keyframes = json::array();
  for (const tsg_KeyframePose& keyframe : elements(message.keyframes)) {
    keyframes.push_back({{"id", keyframe.id},
                         {"stamp_ns", keyframe.stamp_ns},
                         {"T_world_camera", describe_pose(keyframe.T_world_camera)}});
  }
  return {{"header", describe_header(message.header)}, {"keyframes", keyframes}};
}

json to_json(const tsg_CompressedColour& message) {
  return {{"header", describe_header(message.header)},
          {"width", message.width},
          {"height", message.height},
          {"jpeg", {{"bytes", elements(message.jpeg).size()}}}};
}

json to_json(const tsg_CompressedMask& message) {
  return {{"header", describe_header(message.header)},
          {"width", message.width},
          {"height", message.height},
          {"model_name", text_of(message.model_name)},
          {"inference_ns", message.inference_ns},
          {"instances", describe_each(elements(message.instances))},
          {"labels", {{"bytes", elements(message.labels).size()}}}};
}

json to_json(const tsg_Command& message) {
  return {{"id", message.id},
          {"service", message.service},
          {"verb", message.verb},
          {"argument", message.argument}};
}

json to_json(const tsg_Reply& message) {
  return {{"id", message.id},
          {"service", message.service},
          {"ok", message.ok},
          {"exit_code", message.exit_code},
          {"text", message.text}};
}

}  // namespace tsg
