#include "services/map_server/node.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <condition_variable>
#include <cstdio>
#include <filesystem>
#include <mutex>
#include <nlohmann/json.hpp>
#include <thread>
#include <utility>

#include "services/map_server/keyframe_copy.hpp"
#include "services/map_server/map_report.hpp"

namespace tsg {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

constexpr milliseconds kCommandPeriod{20};  // how long commands may lie unanswered
constexpr milliseconds kTickPeriod{200};    // heartbeat and diagnostics while a command waits
constexpr milliseconds kReadTimeout{1000};
constexpr milliseconds kSettleTimeout{20000};  // for keyframes that slam has sent

struct SaveRequest {
  std::filesystem::path folder;
  std::uint64_t keyframes = 0;
};

/// The argument is a JSON object: CommandServer has checked that.
Expected<SaveRequest> parse_save_request(const std::string& argument_json) {
  const nlohmann::json argument = nlohmann::json::parse(argument_json);
  const auto folder = argument.find("folder");
  if (folder == argument.end() || !folder->is_string() || folder->get<std::string>().empty()) {
    return make_error(ExitCode::kUsage,
                      R"(save_map needs {"folder": DIRECTORY, "keyframes": NUMBER}: no folder)");
  }
  SaveRequest request{folder->get<std::string>(), 0};
  const auto keyframes = argument.find("keyframes");
  if (keyframes == argument.end()) return request;  // those integrated by now
  if (!keyframes->is_number_unsigned()) {
    return make_error(ExitCode::kUsage,
                      "save_map: \"keyframes\" is " + keyframes->dump() +
                          ", but must be the number of keyframes sent, 0 or more");
  }
  request.keyframes = keyframes->get<std::uint64_t>();
  return request;
}

std::string with_one_decimal(double value) {
  std::array<char, 32> text{};
  const int length = std::snprintf(text.data(), text.size(), "%.1f", value);
  return {text.data(), static_cast<std::size_t>(length)};
}

}  // namespace

MapServerNode::MapServerNode(const MapServerConfig& config, Bus& bus, const ServiceContext& context)
    : context_(context),
      log_(context.log),
      keyframes_(bus),
      commands_(bus, "map_server"),
      diagnostics_(bus, "map_server"),
      loop_(config, progress_, context.log) {
  commands_.on("save_map", [this](const std::string& argument) { return save_map(argument); });
  commands_.on("report", [this](const std::string&) { return report(); });
}

void MapServerNode::run() {
  std::jthread reader([this] { read_keyframes(context_.stop); });
  context_.ready();
  std::mutex mutex;
  std::condition_variable_any never;
  while (!context_.stop.stop_requested()) {
    commands_.serve_pending();
    tick();
    std::unique_lock lock(mutex);
    never.wait_for(lock, context_.stop, kCommandPeriod, [] { return false; });
  }
  reader.join();
  loop_.stop_and_join();
  const KeyframeCounts counts = progress_.counts();
  if (counts.discarded > 0) {
    log_.warn("keyframes discarded at stop", {{"count", counts.discarded}});
  }
  log_.info(
      "stopped",
      {{"keyframes", counts.integrated}, {"rejected", counts.rejected}, {"missed", counts.missed}});
}

void MapServerNode::read_keyframes(const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    const auto message = keyframes_.take(stop, kReadTimeout);
    if (!message) continue;
    count_missed();
    pass_on(**message, stop);
  }
}

void MapServerNode::count_missed() {
  if (!progress_.set_missed(keyframes_.missed())) return;
  log_.warn("keyframes missed",
            {{"total", keyframes_.missed()}, {"why", "integration is slower than slam sends"}});
}

void MapServerNode::pass_on(const tsg_Keyframe& message, const std::stop_token& stop) {
  auto keyframe = copy_keyframe(message);
  if (keyframe) {
    if (!loop_.submit(std::move(*keyframe), stop)) progress_.add_discarded();
    return;
  }
  progress_.add_rejected(keyframe.error().message);
  log_.warn("keyframe rejected", {{"id", message.id},
                                  {"stamp_ns", message.header.stamp_ns},
                                  {"why", keyframe.error().message}});
}

Expected<std::string> MapServerNode::save_map(const std::string& argument_json) {
  const auto request = parse_save_request(argument_json);
  if (!request) return tl::unexpected(request.error());
  wait_until_settled(request->keyframes);
  const std::uint64_t settled = progress_.counts().settled();

  using Saved = std::pair<MapSummary, MapFiles>;
  auto saved = await(loop_.ask(
      [folder = request->folder](const SemanticMap& map) -> Expected<Saved> {
        return map.save(folder).map(
            [&](const MapFiles& files) { return Saved(map.summary(), files); });
      },
      context_.stop));
  if (!saved) return tl::unexpected(saved.error());
  if (!*saved) {
    log_.error("map not saved", {{"why", saved->error().message}});
    return tl::unexpected(saved->error());
  }
  const auto& [summary, files] = **saved;
  nlohmann::json reply = to_json(summary, progress_.counts(), progress_.integration_ms());
  reply.update(to_json(files));
  reply["keyframes_outstanding"] = std::max(request->keyframes, settled) - settled;
  log_.info("map saved", {{"folder", request->folder.string()},
                          {"keyframes", summary.keyframes},
                          {"leaves", summary.leaves},
                          {"points", files.points}});
  return reply.dump();
}

Expected<std::string> MapServerNode::report() {
  const auto summary =
      await(loop_.ask([](const SemanticMap& map) { return map.summary(); }, context_.stop));
  if (!summary) return tl::unexpected(summary.error());
  nlohmann::json reply = to_json(*summary, progress_.counts(), progress_.integration_ms());
  reply["backlog"] = loop_.backlog();
  return reply.dump();
}

/// A map without the last keyframe is better than none: whoever asks is told what is missing.
void MapServerNode::wait_until_settled(std::uint64_t keyframes) {
  const auto deadline = steady_clock::now() + kSettleTimeout;
  while (!progress_.wait_for_settled(keyframes, kTickPeriod, context_.stop)) {
    if (context_.stop.stop_requested() || steady_clock::now() > deadline) return;
    tick();
  }
}

template <typename Answer>
Expected<Answer> MapServerNode::await(std::optional<std::future<Answer>> answer) {
  while (answer && answer->wait_for(kTickPeriod) != std::future_status::ready) {
    if (context_.stop.stop_requested()) answer.reset();
    tick();
  }
  if (answer) return answer->get();
  return make_error(ExitCode::kUnavailable,
                    "map_server is being stopped; start it again and repeat the command");
}

void MapServerNode::tick() {
  context_.heartbeat();
  if (diagnostics_.is_due()) publish_diagnostics();
}

void MapServerNode::publish_diagnostics() {
  const KeyframeCounts counts = progress_.counts();
  const Summary integration = progress_.integration_ms();
  const std::uint64_t losses = counts.rejected + counts.missed;
  const bool is_losing = losses > std::exchange(reported_losses_, losses);
  Diagnostic diagnostic;
  diagnostic.level = is_losing ? DiagnosticLevel::kWarn : DiagnosticLevel::kOk;
  diagnostic.message = is_losing                ? "keyframes rejected or missed: see the log"
                       : counts.integrated == 0 ? "waiting for keyframes"
                                                : "mapping";
  diagnostic.values = {{"keyframes", std::to_string(counts.integrated)},
                       {"rejected", std::to_string(counts.rejected)},
                       {"missed", std::to_string(counts.missed)},
                       {"backlog", std::to_string(loop_.backlog())},
                       {"integration_p50_ms", with_one_decimal(integration.median)},
                       {"integration_p99_ms", with_one_decimal(integration.p99)}};
  if (const auto published = diagnostics_.publish(diagnostic); !published) {
    log_.warn("diagnostics not published", {{"why", published.error().message}});
  }
}

}  // namespace tsg
