#include "services/slam/node_statistics.hpp"

#include <nlohmann/json.hpp>

#include "common/app/sample_window_json.hpp"

namespace tsg {

void NodeStatistics::add(const TrackResult& result, const FrameTimes& times) {
  if (result.T_world_camera) {
    ++frames_tracked;
  } else {
    ++frames_lost;
  }
  extract_ms.add(to_milliseconds(times.extract_ns));
  match_ms.add(to_milliseconds(times.match_ns));
  optimise_ms.add(to_milliseconds(times.optimise_ns));
  total_ms.add(to_milliseconds(times.total_ns));
  latency_ms.add(to_milliseconds(times.latency_ns));
  if (result.mask_age_frames >= 0) mask_age_frames.add(result.mask_age_frames);
}

nlohmann::json NodeStatistics::to_json() const {
  return {{"frames_tracked", frames_tracked},
          {"frames_lost", frames_lost},
          {"frames_rejected", frames_rejected},
          {"frames_dropped", frames_dropped},
          {"keyframes_sent", keyframes_sent},
          {"keyframes_failed", keyframes_failed},
          {"keyframes_without_mask", keyframes_without_mask},
          {"keyframes_elsewhere", keyframes_elsewhere},
          {"masks_received", masks_received},
          {"mask_age_frames", tsg::to_json(mask_age_frames)},
          {"stage_ms",
           {{"extract", tsg::to_json(extract_ms)},
            {"match", tsg::to_json(match_ms)},
            {"optimise", tsg::to_json(optimise_ms)},
            {"total", tsg::to_json(total_ms)}}},
          {"latency_ms", tsg::to_json(latency_ms)}};
}

}  // namespace tsg
