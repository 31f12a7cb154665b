#pragma once

// Every message as JSON for a person or a script to read (`tsgctl echo`). Images and other bulk
// are summarised (size, mean), not dumped. dump() such JSON with error_handler_t::replace: the
// text on a bus need not be UTF-8.

#include <nlohmann/json.hpp>

#include "common/bus/messages.hpp"

namespace tsg {

[[nodiscard]] nlohmann::json to_json(const tsg_RgbdFrame& message);
[[nodiscard]] nlohmann::json to_json(const tsg_InstanceMask& message);
[[nodiscard]] nlohmann::json to_json(const tsg_Keyframe& message);
[[nodiscard]] nlohmann::json to_json(const tsg_TrackingStatus& message);
[[nodiscard]] nlohmann::json to_json(const tsg_KeyframePoses& message);
[[nodiscard]] nlohmann::json to_json(const tsg_CompressedColour& message);
[[nodiscard]] nlohmann::json to_json(const tsg_CompressedMask& message);
[[nodiscard]] nlohmann::json to_json(const tsg_Command& message);
[[nodiscard]] nlohmann::json to_json(const tsg_Reply& message);
[[nodiscard]] nlohmann::json to_json(const geometry_msgs_msg_dds__PoseStamped_& message);
[[nodiscard]] nlohmann::json to_json(const nav_msgs_msg_dds__Odometry_& message);
[[nodiscard]] nlohmann::json to_json(const nav_msgs_msg_dds__OccupancyGrid_& message);
[[nodiscard]] nlohmann::json to_json(const tf2_msgs_msg_dds__TFMessage_& message);
[[nodiscard]] nlohmann::json to_json(const octomap_msgs_msg_dds__Octomap_& message);
[[nodiscard]] nlohmann::json to_json(const vision_msgs_msg_dds__Detection3DArray_& message);
[[nodiscard]] nlohmann::json to_json(const sensor_msgs_msg_dds__PointCloud2_& message);
[[nodiscard]] nlohmann::json to_json(const diagnostic_msgs_msg_dds__DiagnosticArray_& message);

}  // namespace tsg
