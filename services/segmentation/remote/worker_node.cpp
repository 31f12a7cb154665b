#include "services/segmentation/remote/worker_node.hpp"

#include <chrono>
#include <nlohmann/json.hpp>
#include <opencv2/core/mat.hpp>
#include <stop_token>
#include <utility>
#include <vector>

#include "common/bus/convert.hpp"
#include "common/core/time.hpp"
#include "services/segmentation/lib/remote/image_codec.hpp"
#include "services/segmentation/make_provider.hpp"
#include "services/segmentation/scheduling.hpp"
#include "services/segmentation/waits.hpp"

namespace tsg {

namespace {

// Not "segmentation": the robot's own is that, and both may hear the same commands.
constexpr const char* kWorkerName = "remote_segmentation";

}  // namespace

RemoteWorkerNode::RemoteWorkerNode(const SegmentationConfig& config,
                                   Bus& bus,
                                   const ServiceContext& context)
    : context_(context),
      log_(context.log),
      frames_(bus),
      masks_(bus),
      commands_(bus, kWorkerName),
      status_(bus, context.log, kWorkerName) {
  apply(config.scheduling, log_);
  provider_ = value_or_throw(make_provider(config));
  commands_.on("report", [this](const std::string&) -> Expected<std::string> { return report(); });
}

void RemoteWorkerNode::run() {
  const std::stop_callback cancel(context_.stop, [this] { provider_->cancel(); });
  log_.info("masks for another host from", {{"provider", provider_->name()}});
  context_.ready();
  while (!context_.stop.stop_requested()) {
    if (const auto message = frames_.take_latest(context_.stop, kFrameWait)) answer(**message);
    commands_.serve_pending();
    if (status_.is_due()) {
      status_.publish(counters_, provider_->name(), frames_.passed_over(), provider_->state());
    }
    context_.heartbeat();
  }
}

void RemoteWorkerNode::answer(const tsg_CompressedColour& message) {
  ++counters_.taken;
  const std::int64_t taken_ns = monotonic_ns();
  auto result = segment(message);
  if (context_.stop.stop_requested()) {
    ++counters_.given_up;
    return;
  }
  const auto published =
      result ? publish(message, *result) : Expected<void>(tl::unexpected(result.error()));
  if (published) {
    counters_.add(*result);
    counters_.latency_ms.add(to_milliseconds(monotonic_ns() - taken_ns));
    return;
  }
  ++counters_.failed;
  counters_.last_failure = published.error().message;
  log_.warn("mask withheld", {{"seq", message.header.seq}, {"why", published.error().message}});
}

Expected<SegmentationResult> RemoteWorkerNode::segment(const tsg_CompressedColour& message) {
  Stopwatch watch;
  const std::uint64_t pixels = std::uint64_t{message.width} * message.height;
  if (pixels == 0 || pixels > tsg_MAX_PIXELS) {
    return make_error(ExitCode::kBadData, "a frame came with an impossible size");
  }
  auto colour = decode_colour(elements(message.jpeg), cv::Size(static_cast<int>(message.width),
                                                               static_cast<int>(message.height)));
  if (!colour) return tl::unexpected(colour.error());
  const std::int64_t decoding_ns = watch.lap_ns();
  const RgbdFrame frame{.seq = message.header.seq,
                        .stamp_ns = message.header.stamp_ns,
                        .camera = {},
                        .colour = *colour,
                        .depth = {}};
  cv::Mat labels;
  auto result = provider_->segment(frame, labels);
  if (result) result->times.preprocess_ns += decoding_ns;
  return result;
}

Expected<void> RemoteWorkerNode::publish(const tsg_CompressedColour& message,
                                         const SegmentationResult& result) {
  const auto labels = encode_labels(result.segmentation.labels);
  if (!labels) return tl::unexpected(labels.error());
  std::vector<tsg_Instance> instances;
  for (const Instance& instance : result.segmentation.instances) {
    auto converted = to_message(instance);
    if (!converted) return tl::unexpected(converted.error());
    instances.push_back(*converted);
  }
  tsg_CompressedMask answer{.header = message.header,
                            .width = message.width,
                            .height = message.height,
                            .model_name = {},
                            .inference_ns = result.times.total_ns(),
                            .instances = {},
                            .labels = {}};
  provider_->name().copy(answer.model_name, sizeof(answer.model_name) - 1);
  lend(instances, answer.instances);
  lend(*labels, answer.labels);
  return masks_.publish(answer);
}

std::string RemoteWorkerNode::report() const {
  nlohmann::json report = counters_.to_json();
  report["provider"] = provider_->name();
  report["passed_over"] = frames_.passed_over();
  return report.dump();
}

}  // namespace tsg
