#pragma once

#include <cstdint>
#include <future>
#include <optional>
#include <stop_token>
#include <string>

#include "common/app/run_service.hpp"
#include "common/bus/bus.hpp"
#include "common/bus/command.hpp"
#include "common/bus/diagnostics.hpp"
#include "common/bus/topics.hpp"
#include "services/map_server/config.hpp"
#include "services/map_server/integration_loop.hpp"
#include "services/map_server/progress.hpp"

namespace tsg {

/// Takes keyframes in and answers commands. Three threads: the reader copies keyframes out of
/// shared memory, the integration loop owns the map, the caller's does commands and diagnostics.
class MapServerNode {
 public:
  MapServerNode(const MapServerConfig& config, Bus& bus, const ServiceContext& context);

  /// Returns once stopped and drained.
  void run();

 private:
  void read_keyframes(const std::stop_token& stop);
  void count_missed();
  void pass_on(const tsg_Keyframe& message, const std::stop_token& stop);

  Expected<std::string> save_map(const std::string& argument_json);
  Expected<std::string> report();
  void wait_until_settled(std::uint64_t keyframes);
  template <typename Answer>
  Expected<Answer> await(std::optional<std::future<Answer>> answer);

  void tick();
  void publish_diagnostics();

  const ServiceContext& context_;
  Log log_;
  Subscriber<topics::Keyframe> keyframes_;  // of the reader
  CommandServer commands_;
  DiagnosticsPublisher diagnostics_;
  Progress progress_;
  IntegrationLoop loop_;
  std::uint64_t reported_losses_ = 0;  // as of the last diagnostics
};

}  // namespace tsg
