#pragma once

// The wiring list: every topic with its type, domain and quality of service, written once.
// docs/architecture.md has the picture. Types: idl/tsg (ours), idl/ros2 (standard ROS 2 layouts).

#include <tuple>

#include "common/bus/messages.hpp"
#include "common/bus/qos.hpp"

namespace tsg::topics {

struct Rgbd {
  using Message = tsg_RgbdFrame;
  static constexpr const char* kName = "tsg/rgbd";
  // Tracking may fall a quarter of a second behind, on a busy machine, before it misses a frame.
  static constexpr Qos kQos{.domain = Domain::kSharedMemory, .keep_last = 8};
};

struct Instances {
  using Message = tsg_InstanceMask;
  static constexpr const char* kName = "tsg/instances";
  static constexpr Qos kQos{.domain = Domain::kSharedMemory, .keep_last = 4};
};

struct Keyframe {
  using Message = tsg_Keyframe;
  static constexpr const char* kName = "tsg/keyframe";
  static constexpr Qos kQos{.domain = Domain::kSharedMemory, .keep_last = 8};
};

struct TrackingStatus {
  using Message = tsg_TrackingStatus;
  static constexpr const char* kName = "tsg/tracking_status";
  // Latched: whoever slam has not discovered yet when it answers a frame still gets the answer.
  static constexpr Qos kQos{.durability = Durability::kTransientLocal, .keep_last = 64};
};

struct KeyframePoses {
  using Message = tsg_KeyframePoses;
  static constexpr const char* kName = "tsg/keyframe_poses";
  static constexpr Qos kQos{.keep_last = 1};
};

/// Frames for segmentation on another host, and its answers (services/segmentation/remote). So many
/// are kept as may be under way, since what was lost of them is sent again.
struct RemoteColour {
  using Message = tsg_CompressedColour;
  static constexpr const char* kName = "tsg/remote/colour";
  static constexpr Qos kQos{.keep_last = 4};
};

struct RemoteMask {
  using Message = tsg_CompressedMask;
  static constexpr const char* kName = "tsg/remote/mask";
  static constexpr Qos kQos{.keep_last = 4};
};

struct Command {
  using Message = tsg_Command;
  static constexpr const char* kName = "tsg/command";
  static constexpr Qos kQos{.keep_last = 16};
};

struct Reply {
  using Message = tsg_Reply;
  static constexpr const char* kName = "tsg/reply";
  static constexpr Qos kQos{.keep_last = 16};
};

struct Pose {
  using Message = geometry_msgs_msg_dds__PoseStamped_;
  static constexpr const char* kName = "rt/tsg/pose";
  static constexpr Qos kQos{};
};

struct Odometry {
  using Message = nav_msgs_msg_dds__Odometry_;
  static constexpr const char* kName = "rt/tsg/odom";
  static constexpr Qos kQos{};
};

struct Transforms {
  using Message = tf2_msgs_msg_dds__TFMessage_;
  static constexpr const char* kName = "rt/tf";
  static constexpr Qos kQos{};
};

struct Octomap {
  using Message = octomap_msgs_msg_dds__Octomap_;
  static constexpr const char* kName = "rt/tsg/octomap";
  static constexpr Qos kQos{.durability = Durability::kTransientLocal, .keep_last = 1};
};

struct Objects {
  using Message = vision_msgs_msg_dds__Detection3DArray_;
  static constexpr const char* kName = "rt/tsg/objects";
  static constexpr Qos kQos{.durability = Durability::kTransientLocal, .keep_last = 1};
};

struct Cloud {
  using Message = sensor_msgs_msg_dds__PointCloud2_;
  static constexpr const char* kName = "rt/tsg/cloud";
  static constexpr Qos kQos{.durability = Durability::kTransientLocal, .keep_last = 1};
};

struct Grid {
  using Message = nav_msgs_msg_dds__OccupancyGrid_;
  static constexpr const char* kName = "rt/tsg/grid";
  static constexpr Qos kQos{.durability = Durability::kTransientLocal, .keep_last = 1};
};

struct Diagnostics {
  using Message = diagnostic_msgs_msg_dds__DiagnosticArray_;
  static constexpr const char* kName = "rt/diagnostics";
  static constexpr Qos kQos{};
};

/// All of them, for what handles any topic by its name.
using All = std::tuple<Rgbd,
                       Instances,
                       Keyframe,
                       TrackingStatus,
                       KeyframePoses,
                       RemoteColour,
                       RemoteMask,
                       Command,
                       Reply,
                       Pose,
                       Odometry,
                       Transforms,
                       Octomap,
                       Objects,
                       Cloud,
                       Grid,
                       Diagnostics>;

}  // namespace tsg::topics
