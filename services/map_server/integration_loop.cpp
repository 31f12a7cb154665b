#include "services/map_server/integration_loop.hpp"

#include "common/core/time.hpp"

namespace tsg {

IntegrationLoop::IntegrationLoop(const MapServerConfig& config, Progress& progress, Log log)
    : progress_(progress),
      log_(std::move(log)),
      map_(config.map),
      jobs_(static_cast<std::size_t>(config.queue_keyframes), WhenFull::kBlock),
      thread_([this](const std::stop_token& stop) { run(stop); }) {}

bool IntegrationLoop::submit(MapKeyframe keyframe, const std::stop_token& stop) {
  return jobs_.push(Job(std::move(keyframe)), stop);
}

void IntegrationLoop::stop_and_join() {
  thread_.request_stop();
  if (thread_.joinable()) thread_.join();
}

void IntegrationLoop::run(const std::stop_token& stop) {
  using Clock = std::chrono::steady_clock;
  std::optional<Clock::time_point> drain_until;
  while (auto job = jobs_.pop(stop)) {
    if (stop.stop_requested() && !drain_until) drain_until = Clock::now() + kDrainTime;
    if (const auto* question = std::get_if<MapQuestion>(&*job)) {
      (*question)(map_);
    } else if (drain_until && Clock::now() > *drain_until) {
      progress_.add_discarded();
    } else {
      integrate(std::get<MapKeyframe>(*job));
    }
  }
}

void IntegrationLoop::integrate(const MapKeyframe& keyframe) {
  Stopwatch watch;
  const auto integrated = map_.integrate(keyframe);
  if (integrated) {
    progress_.add_integrated(to_milliseconds(watch.lap_ns()));
    return;
  }
  progress_.add_rejected(integrated.error().message);
  log_.warn("keyframe rejected", {{"id", keyframe.id},
                                  {"stamp_ns", keyframe.frame.stamp_ns},
                                  {"why", integrated.error().message}});
}

}  // namespace tsg
