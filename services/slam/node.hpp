#pragma once

#include <memory>
#include <optional>

#include "common/app/run_service.hpp"
#include "common/bus/bus.hpp"
#include "common/bus/command.hpp"
#include "common/bus/diagnostics.hpp"
#include "common/bus/topics.hpp"
#include "common/core/time.hpp"
#include "services/slam/config.hpp"
#include "services/slam/dense_keyframes.hpp"
#include "services/slam/keyframe_publisher.hpp"
#include "services/slam/lib/trajectory_recorder.hpp"
#include "services/slam/mapping_loop.hpp"
#include "services/slam/mask_input.hpp"
#include "services/slam/node_statistics.hpp"
#include "services/slam/odometry.hpp"
#include "services/slam/pose_publisher.hpp"

namespace tsg {

/// The service: frames and masks in, poses, status and keyframes out (README.md). One thread
/// tracks and owns everything here; MappingLoop has a second one in real time.
class SlamNode {
 public:
  SlamNode(const SlamNodeConfig& config, Bus& bus, const ServiceContext& context);

  /// Returns once stopped. Throws FatalError (kTimeout) where lockstep waits in vain for a mask.
  void run();

 private:
  /// What depends on the camera, which the first frame tells.
  struct Session {
    Session(const SlamNodeConfig& config, const CameraModel& camera, StageTimer& timer);

    CameraModel camera;
    Tracker tracker;
    MappingLoop mapping;
  };

  void serve_commands();
  void handle(const Sample<topics::Rgbd>& sample);
  [[nodiscard]] Expected<RgbdFrame> accept(const tsg_RgbdFrame& message);
  [[nodiscard]] const InstanceSegmentation* mask_for(const RgbdFrame& frame);
  [[nodiscard]] TrackResult track(const RgbdFrame& frame, const InstanceSegmentation* mask);
  void update_map(const RgbdFrame& frame, TrackResult& result, const InstanceSegmentation* mask);
  void publish_corrections();
  void publish_pose(const TrackResult& result);
  void publish_status(const RgbdFrame& frame, const TrackResult& result, const FrameTimes& times);
  void publish_rejection(const tsg_RgbdFrame& message, const std::string& why);
  void send(const std::optional<DenseKeyframe>& keyframe);
  void log_state(const TrackResult& result);
  void publish_diagnostics();
  [[nodiscard]] Expected<std::string> save_trajectory(const std::string& argument_json);
  [[nodiscard]] std::string report();

  SlamNodeConfig config_;
  const ServiceContext& context_;
  Log log_;

  Subscriber<topics::Rgbd> frames_;
  MaskInput masks_;
  PosePublisher poses_;
  Publisher<topics::TrackingStatus> status_;
  KeyframePublisher keyframes_;
  CommandServer commands_;
  DiagnosticsPublisher diagnostics_;

  StageTimer timer_;
  std::unique_ptr<Session> session_;  // null before the first frame
  Odometry odometry_;
  DenseKeyframes dense_keyframes_;
  TrajectoryRecorder trajectory_;
  std::shared_ptr<const std::vector<KeyframePose>> corrected_;  // as published last
  NodeStatistics statistics_;
  TrackingState state_ = TrackingState::kInitialising;
  std::int64_t last_stamp_ns_ = 0;
  Stopwatch since_diagnostics_;
  std::uint64_t answered_at_diagnostics_ = 0;
};

}  // namespace tsg
