#include "services/slam/status_message.hpp"

#include <algorithm>
#include <cstring>

namespace tsg {
namespace {

tsg_TrackingState to_message(TrackingState state) {
  switch (state) {
    case TrackingState::kInitialising:
      return tsg_TRACKING_INITIALISING;
    case TrackingState::kTracking:
      return tsg_TRACKING_OK;
    case TrackingState::kLost:
      return tsg_TRACKING_LOST;
  }
  return tsg_TRACKING_LOST;
}

std::uint32_t count(std::size_t value) { return static_cast<std::uint32_t>(value); }

}  // namespace

tsg_TrackingStatus to_message(const TrackResult& result,
                              const LocalMapSnapshot& map,
                              const FrameTimes& times) {
  tsg_TrackingStatus message{};
  message.state = to_message(result.state);
  set_reason(message, result.reason);
  const FeatureCounts& features = result.features;
  message.features = static_cast<std::uint32_t>(features.detected);
  message.features_dynamic = static_cast<std::uint32_t>(features.dynamic);
  message.features_static = static_cast<std::uint32_t>(features.detected - features.dynamic);
  message.matches = static_cast<std::uint32_t>(result.matches);
  message.inliers = static_cast<std::uint32_t>(result.inliers);
  message.keyframes = count(map.map_keyframes);
  message.map_points = count(map.map_points);
  message.mask_age_frames = result.mask_age_frames;
  message.extract_ns = times.extract_ns;
  message.match_ns = times.match_ns;
  message.optimise_ns = times.optimise_ns;
  message.total_ns = times.total_ns;
  message.latency_ns = times.latency_ns;
  return message;
}

void set_reason(tsg_TrackingStatus& message, std::string_view reason) {
  const std::size_t length = std::min(reason.size(), sizeof(message.reason) - 1);
  std::memcpy(message.reason, reason.data(), length);
  message.reason[length] = '\0';
}

const char* to_text(TrackingState state) {
  switch (state) {
    case TrackingState::kInitialising:
      return "initialising";
    case TrackingState::kTracking:
      return "tracking";
    case TrackingState::kLost:
      return "lost";
  }
  return "?";
}

}  // namespace tsg
