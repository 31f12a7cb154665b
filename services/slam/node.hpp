#pragma once

#include <filesystem>
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
#include "services/slam/map_jobs.hpp"
#include "services/slam/mapping_loop.hpp"
#include "services/slam/mask_input.hpp"
#include "services/slam/node_statistics.hpp"
#include "services/slam/odometry.hpp"
#include "services/slam/pose_publisher.hpp"
#include "services/slam/status_message.hpp"

namespace tsg {

/// The service: frames and masks in, poses, status and keyframes out (README.md). One thread
/// tracks and owns everything here; MappingLoop has a second one in real time.
class SlamNode {
 public:
  /// Throws FatalError where the map to start in cannot be loaded.
  SlamNode(const SlamNodeConfig& config, Bus& bus, const ServiceContext& context);

  /// Returns once stopped. Throws FatalError: kTimeout where lockstep waits in vain for a mask,
  /// kConfig where the camera is not the one of the map that slam was to start in.
  void run();

 private:
  /// What depends on the camera, which the first frame tells.
  struct Session {
    Session(const SlamNodeConfig& config,
            const CameraModel& camera,
            StageTimer& timer,
            LocalMapper mapper);

    CameraModel camera;
    std::filesystem::path map_file = {};  // that it began with; empty: with a new map
    KeyframeId first_keyframe = 0;        // those before came with the map
    Tracker tracker;
    MappingLoop mapping;
  };

  void add_map_commands();
  void start_in_map(const std::filesystem::path& file);
  void enter(LoadedMap&& map);
  [[nodiscard]] static std::string other_camera(const std::filesystem::path& file,
                                                const CameraModel& of_map,
                                                const CameraModel& of_frames);
  [[nodiscard]] Expected<CommandServer::Pending> save_map(const std::string& argument_json);
  [[nodiscard]] Expected<CommandServer::Pending> load_map(const std::string& argument_json);
  [[nodiscard]] std::string map_info();
  void handle(const Sample<topics::Rgbd>& sample);
  [[nodiscard]] Expected<RgbdFrame> accept(const tsg_RgbdFrame& message);
  [[nodiscard]] const InstanceSegmentation* mask_for(const RgbdFrame& frame);
  [[nodiscard]] TrackResult track(const RgbdFrame& frame, const InstanceSegmentation* mask);
  void update_map(const RgbdFrame& frame, TrackResult& result, const InstanceSegmentation* mask);
  /// Whether the pose is in the frame `map`, rather than in a part of the map of its own.
  [[nodiscard]] bool is_in_map(const TrackResult& result) const;
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
  MapPart part_ = 0;  // of the map, that the camera was in last
  TrackingState state_ = TrackingState::kInitialising;
  std::int64_t last_stamp_ns_ = 0;
  Stopwatch since_diagnostics_;
  std::uint64_t answered_at_diagnostics_ = 0;
};

}  // namespace tsg
