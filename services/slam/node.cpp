#include "services/slam/node.hpp"

#include <chrono>
#include <nlohmann/json.hpp>
#include <utility>

#include "common/bus/convert.hpp"
#include "common/core/time.hpp"
#include "services/slam/results.hpp"

namespace tsg {
namespace {

// Without frames the loop still serves commands and the watchdog.
constexpr std::chrono::milliseconds kIdlePeriod{50};
constexpr double kNsPerSecond = 1e9;

std::chrono::milliseconds to_duration(double seconds) {
  return std::chrono::duration_cast<std::chrono::milliseconds>(
      std::chrono::duration<double>(seconds));
}

}  // namespace

SlamNode::Session::Session(const SlamNodeConfig& config,
                           const CameraModel& frame_camera,
                           StageTimer& timer,
                           LocalMapper mapper)
    : camera(frame_camera),
      tracker(config.core, frame_camera, [&timer](TrackingStage stage) { timer.begin(stage); }),
      mapping(std::move(mapper),
              config.lockstep ? MappingMode::kSynchronous : MappingMode::kConcurrent) {}

SlamNode::SlamNode(const SlamNodeConfig& config, Bus& bus, const ServiceContext& context)
    : config_(config),
      context_(context),
      log_(context.log),
      frames_(bus),
      masks_(bus),
      poses_(bus),
      status_(bus),
      keyframes_(bus),
      commands_(bus, "slam"),
      diagnostics_(bus, "slam"),
      dense_keyframes_(config.expect_masks,
                       static_cast<std::int64_t>(config.keyframe_mask_wait_s * kNsPerSecond)) {
  commands_.on("save_trajectory",
               [this](const std::string& argument) { return save_trajectory(argument); });
  commands_.on("report", [this](const std::string&) -> Expected<std::string> { return report(); });
  add_map_commands();
  if (!config.map_to_load.empty()) start_in_map(config.map_to_load);
}

void SlamNode::run() {
  context_.ready();
  while (!context_.stop.stop_requested()) {
    if (const auto sample = frames_.take(context_.stop, kIdlePeriod)) handle(*sample);
    keyframes_.watch_subscribers();
    commands_.serve_pending();
    context_.heartbeat();
    if (diagnostics_.is_due()) publish_diagnostics();
  }
}

void SlamNode::handle(const Sample<topics::Rgbd>& sample) {
  timer_.start_frame();
  const auto frame = accept(*sample);
  if (!frame) {
    publish_rejection(*sample, frame.error().message);
    return;
  }
  const InstanceSegmentation* mask = mask_for(*frame);
  TrackResult result = track(*frame, mask);
  publish_pose(result);
  const FrameTimes times = timer_.end_frame(sample->header.publish_monotonic_ns);
  trajectory_.record(result);
  statistics_.add(result, times);
  update_map(*frame, result, mask);
  publish_corrections();
  publish_status(*frame, result, times);
  log_state(result);
}

Expected<RgbdFrame> SlamNode::accept(const tsg_RgbdFrame& message) {
  auto frame = view_as_frame(message);
  if (!frame) return frame;
  if (session_ == nullptr) {
    session_ = std::make_unique<Session>(config_, frame->camera, timer_,
                                         LocalMapper(config_.core, frame->camera));
  } else if (last_stamp_ns_ == 0 && !(frame->camera == session_->camera)) {
    throw FatalError(ExitCode::kConfig,
                     other_camera(session_->map_file, session_->camera, frame->camera));
  } else if (!(frame->camera == session_->camera)) {
    return make_error(ExitCode::kSizeMismatch,
                      "the camera's size or intrinsics changed: restart slam for another camera");
  } else if (frame->stamp_ns <= last_stamp_ns_) {
    return make_error(ExitCode::kBadData, "its stamp is not later than the previous frame's");
  }
  last_stamp_ns_ = frame->stamp_ns;
  return frame;
}

const InstanceSegmentation* SlamNode::mask_for(const RgbdFrame& frame) {
  if (!config_.lockstep || !config_.expect_masks) {
    if (masks_.update()) {
      session_->mapping.apply_mask(*masks_.newest());
      send(dense_keyframes_.add_mask(*masks_.newest()));
    }
    return masks_.newest();
  }
  const auto patience = to_duration(config_.lockstep_mask_wait_s);
  if (!masks_.wait_for(frame.seq, patience, context_.stop) && !context_.stop.stop_requested()) {
    throw FatalError(ExitCode::kTimeout,
                     "no mask of frame " + std::to_string(frame.seq) + " within " +
                         std::to_string(patience.count() / 1000) +
                         " s: lockstep needs one for every frame; look at the log of segmentation, "
                         "or set slam.expect_masks=false");
  }
  return masks_.newest();
}

TrackResult SlamNode::track(const RgbdFrame& frame, const InstanceSegmentation* mask) {
  const auto features = session_->tracker.extract(frame, mask);
  const auto map = session_->mapping.snapshot();
  TrackResult result = session_->tracker.track(features, *map);
  if (result.state == TrackingState::kLost) session_->mapping.recall(features);
  return result;
}

void SlamNode::update_map(const RgbdFrame& frame,
                          TrackResult& result,
                          const InstanceSegmentation* mask) {
  session_->mapping.remove_points(std::move(result.dynamic_points));
  const bool is_keyframe = result.keyframe.has_value();
  if (is_keyframe) session_->mapping.insert(std::move(*result.keyframe));
  if (!result.T_world_camera) return;
  if (config_.core.tracker.localisation_only) session_->mapping.centre_on(result.reference);
  if (!is_in_map(result)) {  // the map server has no place for it
    if (is_keyframe) ++statistics_.keyframes_elsewhere;
    return;
  }
  const bool is_own_mask = mask != nullptr && mask->frame_seq == frame.seq;
  const KeyframePlace place{.T_map_camera = Odometry::T_map_world() * *result.T_world_camera,
                            .reference = result.reference,
                            .T_reference_camera = result.T_reference_camera};
  send(dense_keyframes_.add_frame(frame, place, is_keyframe, is_own_mask ? mask : nullptr));
}

void SlamNode::publish_corrections() {
  auto corrected = session_->mapping.corrected_poses();
  if (corrected == corrected_) return;
  corrected_ = std::move(corrected);
  std::vector<KeyframePose> in_map = *corrected_;
  const MapPart main_part = session_->mapping.snapshot()->main_part;
  std::erase_if(in_map, [main_part](const KeyframePose& pose) { return pose.part != main_part; });
  log_.info("map corrected by a loop",
            {{"keyframes", in_map.size()}, {"in_other_parts", corrected_->size() - in_map.size()}});
  if (const auto published = keyframes_.publish_poses(in_map); !published) {
    log_.warn("corrected poses not published", {{"why", published.error().message}});
  }
}

bool SlamNode::is_in_map(const TrackResult& result) const {
  return result.part == session_->mapping.snapshot()->main_part;
}

void SlamNode::publish_pose(const TrackResult& result) {
  const auto pose = odometry_.update(result);
  if (!pose) return;
  const std::string map_frame = is_in_map(result) ? "map" : "map_" + std::to_string(result.part);
  if (const auto published = poses_.publish(*pose, map_frame); !published) {
    log_.warn("pose not published", {{"why", published.error().message}});
  }
}

void SlamNode::publish_status(const RgbdFrame& frame,
                              const TrackResult& result,
                              const FrameTimes& times) {
  tsg_TrackingStatus message = to_message(result, *session_->mapping.snapshot(), times);
  message.header = {
      .seq = frame.seq, .stamp_ns = frame.stamp_ns, .publish_monotonic_ns = monotonic_ns()};
  message.frames_dropped = frames_.missed();
  if (result.T_world_camera && !is_in_map(result)) {
    set_reason(message, "in part " + std::to_string(result.part) +
                            " of the map, which has not been joined with the rest yet");
  }
  if (const auto published = status_.publish(message); !published) {
    log_.warn("status not published", {{"why", published.error().message}});
  }
}

void SlamNode::publish_rejection(const tsg_RgbdFrame& message, const std::string& why) {
  ++statistics_.frames_rejected;
  log_.warn("frame rejected", {{"stamp_ns", message.header.stamp_ns}, {"why", why}});
  tsg_TrackingStatus status{};
  status.header = message.header;
  status.header.publish_monotonic_ns = monotonic_ns();
  status.state = tsg_TRACKING_LOST;
  status.mask_age_frames = -1;
  status.frames_dropped = frames_.missed();
  set_reason(status, "frame rejected: " + why);
  if (const auto published = status_.publish(status); !published) {
    log_.warn("status not published", {{"why", published.error().message}});
  }
}

void SlamNode::send(const std::optional<DenseKeyframe>& keyframe) {
  if (!keyframe) return;
  if (const auto sent = keyframes_.publish(*keyframe); !sent) {
    ++statistics_.keyframes_failed;
    log_.warn("keyframe not sent", {{"why", sent.error().message}});
  }
}

void SlamNode::log_state(const TrackResult& result) {
  if (result.T_world_camera && std::exchange(part_, result.part) != result.part) {
    log_.info("in another part of the map",
              {{"part", result.part}, {"is_main", is_in_map(result)}});
  }
  if (result.state == state_) return;
  state_ = result.state;
  const std::string event = std::string("tracking state: ") + to_text(state_);
  if (state_ == TrackingState::kLost) {
    log_.warn(event, {{"stamp_ns", result.stamp_ns}, {"why", result.reason}});
  } else {
    log_.info(event, {{"stamp_ns", result.stamp_ns}, {"inliers", result.inliers}});
  }
}

void SlamNode::publish_diagnostics() {
  const bool has_frames = last_stamp_ns_ != 0;
  const bool is_well = state_ == TrackingState::kTracking || !has_frames;
  std::string text = has_frames ? to_text(state_) : "waiting for frames";
  if (config_.core.tracker.localisation_only) text += " (localisation only)";
  Diagnostic diagnostic{.level = is_well ? DiagnosticLevel::kOk : DiagnosticLevel::kWarn,
                        .message = std::move(text),
                        .values = {}};
  const auto add = [&](const char* key, auto value) {
    diagnostic.values.emplace_back(key, std::to_string(value));
  };
  const std::uint64_t answered = statistics_.frames_tracked + statistics_.frames_lost;
  const double elapsed_s = to_seconds(since_diagnostics_.lap_ns());
  const auto since_last = static_cast<double>(answered - answered_at_diagnostics_);
  answered_at_diagnostics_ = answered;
  add("rate_hz", elapsed_s > 0.0 ? since_last / elapsed_s : 0.0);
  add("frames_tracked", statistics_.frames_tracked);
  add("frames_lost", statistics_.frames_lost);
  add("frames_dropped", frames_.missed());
  add("keyframes_sent", keyframes_.sent());
  add("map_keyframes", session_ == nullptr ? 0 : session_->mapping.snapshot()->map_keyframes);
  add("masks_received", masks_.received());
  const Summary latency_ms = statistics_.latency_ms.summary();
  add("latency_p50_ms", latency_ms.median);
  add("latency_p99_ms", latency_ms.p99);
  if (const auto published = diagnostics_.publish(diagnostic); !published) {
    log_.warn("diagnostics not published", {{"why", published.error().message}});
  }
}

Expected<std::string> SlamNode::save_trajectory(const std::string& argument_json) {
  const auto argument = nlohmann::json::parse(argument_json);
  if (!argument.contains("folder") || !argument["folder"].is_string()) {
    return make_error(ExitCode::kUsage, R"(save_trajectory needs {"folder": "..."})");
  }
  if (session_ == nullptr || trajectory_.tracked() == 0) {
    return make_error(ExitCode::kEmptyInput,
                      "no frame has been tracked, so there is no trajectory to save");
  }
  send(dense_keyframes_.flush());
  return save_results(argument["folder"].get<std::string>(), trajectory_,
                      session_->mapping.keyframe_poses(), session_->first_keyframe)
      .map([this] { return report(); });
}

std::string SlamNode::report() {
  statistics_.frames_dropped = frames_.missed();
  statistics_.keyframes_sent = keyframes_.sent();
  statistics_.keyframes_without_mask = dense_keyframes_.without_mask();
  statistics_.masks_received = masks_.received();
  return statistics_.to_json().dump();
}

}  // namespace tsg
