#include "services/segmentation/remote/relay_node.hpp"

#include <algorithm>
#include <chrono>
#include <iterator>
#include <nlohmann/json.hpp>
#include <opencv2/core/mat.hpp>
#include <thread>
#include <utility>

#include "common/bus/convert.hpp"
#include "common/bus/field_text.hpp"
#include "common/core/time.hpp"
#include "services/segmentation/lib/remote/image_codec.hpp"
#include "services/segmentation/scheduling.hpp"
#include "services/segmentation/waits.hpp"

namespace tsg {

namespace {

constexpr std::chrono::milliseconds kAnswerWait{100};  // how long a new reader may be unsettled

std::vector<Instance> instances_of(const tsg_CompressedMask& answer) {
  std::vector<Instance> instances;
  for (const tsg_Instance& instance : elements(answer.instances)) {
    instances.push_back(to_instance(instance));
  }
  return instances;
}

}  // namespace

RelayNode::RelayNode(const SegmentationConfig& config, Bus& bus, const ServiceContext& context)
    : config_(config.remote),
      interface_(bus.context().config().interface),
      context_(context),
      log_(context.log),
      frames_(bus),
      colours_(bus),
      commands_(bus, "segmentation"),
      status_(bus, context.log, "segmentation"),
      answers_(bus),
      masks_(bus),
      under_way_(static_cast<std::size_t>(config.remote.frames_under_way),
                 std::int64_t{config.remote.patience_ms} * 1'000'000) {
  apply(config.scheduling, log_);
  commands_.on("report", [this](const std::string&) -> Expected<std::string> { return report(); });
}

void RelayNode::run() {
  log_.info("masks from another host", {{"interface", interface_}});
  const std::jthread returning([this](const std::stop_token& stop) { return_masks(stop); });
  context_.ready();
  while (!context_.stop.stop_requested()) {
    if (const auto message = frames_.take_latest(context_.stop, kFrameWait)) relay(**message);
    commands_.serve_pending();
    if (status_.is_due()) {
      const Counted counted = count_up();
      status_.publish(counted.counters, counted.model_name, passed_over(), state());
    }
    context_.heartbeat();
  }
}

void RelayNode::relay(const tsg_RgbdFrame& message) {
  const bool is_heard = colours_.subscriber_count() > 0;
  {
    const std::scoped_lock lock(mutex_);
    if (!is_heard || !under_way_.has_room(monotonic_ns())) {
      ++no_room_;
      return;
    }
    ++counters_.taken;
    counters_.input_age_ms.add(
        to_milliseconds(monotonic_ns() - message.header.publish_monotonic_ns));
  }
  if (const auto sent = send(message); !sent) withhold(message.header.seq, sent.error());
}

Expected<void> RelayNode::send(const tsg_RgbdFrame& message) {
  SentFrame sent{.seq = message.header.seq,
                 .stamp_ns = message.header.stamp_ns,
                 .width = message.intrinsics.width,
                 .height = message.intrinsics.height,
                 .published_ns = message.header.publish_monotonic_ns,
                 .taken_ns = monotonic_ns()};
  const auto frame = view_as_frame(message);
  if (!frame) return tl::unexpected(frame.error());
  const auto jpeg = encode_colour(frame->colour, config_.jpeg_quality);
  if (!jpeg) return tl::unexpected(jpeg.error());
  sent.sent_ns = monotonic_ns();
  sent.compressing_ns = sent.sent_ns - sent.taken_ns;
  tsg_CompressedColour colour{.header = {sent.seq, sent.stamp_ns, sent.sent_ns},
                              .width = sent.width,
                              .height = sent.height,
                              .jpeg = {}};
  lend(*jpeg, colour.jpeg);
  {
    const std::scoped_lock lock(mutex_);  // before it is sent: the answer may be quick
    counters_.given_up += under_way_.add(sent);
  }
  auto published = colours_.publish(colour);
  if (!published) {
    const std::scoped_lock lock(mutex_);
    under_way_.remove(sent.seq, sent.sent_ns);
  }
  return published;
}

/// Masks come when they do, not when frames do, so they are waited for in a thread of their own.
void RelayNode::return_masks(const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    const auto answer = answers_.take(stop, kAnswerWait);
    settle_readers();
    if (!answer) continue;
    std::optional<FramesUnderWay::Answered> answered;
    {
      const std::scoped_lock lock(mutex_);
      answered = under_way_.take((*answer)->header.seq, (*answer)->header.publish_monotonic_ns);
      if (!answered) continue;  // of another robot's frame, or too late
      counters_.given_up += answered->overtaken;
      round_trip_ms_.add(to_milliseconds(monotonic_ns() - answered->frame.sent_ns));
    }
    if (const auto published = publish(**answer, answered->frame); !published) {
      withhold(answered->frame.seq, published.error());
    }
  }
}

Expected<void> RelayNode::publish(const tsg_CompressedMask& answer, const SentFrame& frame) {
  Stopwatch watch;
  if (answer.width != frame.width || answer.height != frame.height) {
    return make_error(ExitCode::kBadData,
                      "a mask came back that is not of its frame's size; both "
                      "hosts must run the same version of tsg-segmentation");
  }
  auto loan = loan_for_mask();
  if (!loan) return tl::unexpected(loan.error());
  tsg_InstanceMask& message = **loan;
  InstanceSegmentation mask{
      .frame_seq = frame.seq,
      .stamp_ns = frame.stamp_ns,
      .labels = cv::Mat(static_cast<int>(frame.height), static_cast<int>(frame.width), CV_8UC1,
                        message.labels),
      .instances = instances_of(answer)};
  auto decoded = decode_labels(elements(answer.labels), mask.instances.size(), mask.labels);
  if (!decoded) return decoded;
  if (auto filled = fill_message(mask, message); !filled) return filled;
  std::copy(std::begin(answer.model_name), std::end(answer.model_name), message.model_name);
  message.inference_ns = answer.inference_ns;
  message.input_age_ns = frame.taken_ns - frame.published_ns;
  if (auto published = masks_.publish(std::move(*loan)); !published) return published;
  count(answer, frame, watch.lap_ns());
  return {};
}

void RelayNode::count(const tsg_CompressedMask& answer,
                      const SentFrame& frame,
                      std::int64_t decoding_ns) {
  SegmentationResult result;
  result.times = {.preprocess_ns = frame.compressing_ns,
                  .network_ns = answer.inference_ns,
                  .postprocess_ns = decoding_ns};
  const std::scoped_lock lock(mutex_);
  counters_.add(result);
  counters_.latency_ms.add(to_milliseconds(monotonic_ns() - frame.published_ns));
  model_name_ = text_of(answer.model_name);
}

/// What is published before the first reader is known would be lost to it.
Expected<Loan<topics::Instances>> RelayNode::loan_for_mask() {
  if (!std::exchange(has_published_, true)) {
    masks_.wait_for_subscribers(1, kFirstReaderWait, context_.stop);
  }
  return masks_.loan();
}

void RelayNode::settle_readers() {
  masks_.wait_for_subscribers(masks_.subscriber_count(), kNoWait, context_.stop);
}

void RelayNode::withhold(std::uint64_t seq, const Error& why) {
  {
    const std::scoped_lock lock(mutex_);
    ++counters_.failed;
    counters_.last_failure = why.message;
  }
  log_.warn("mask withheld", {{"seq", seq}, {"why", why.message}});
}

ProviderState RelayNode::state() {
  const int hosts = colours_.subscriber_count();
  const std::scoped_lock lock(mutex_);
  const bool is_silent = hosts > 0 && under_way_.is_silent(monotonic_ns());
  const Summary round_trip = round_trip_ms_.summary();
  ProviderState state;
  state.values = {{"link", hosts == 0 ? "nobody there" : (is_silent ? "silent" : "up")},
                  {"lost", std::to_string(counters_.given_up)},
                  {"round_trip_p50_ms", with_one_decimal(round_trip.median)},
                  {"round_trip_p99_ms", with_one_decimal(round_trip.p99)}};
  if (hosts == 0) {
    state.problem = "no other host offers segmentation on interface " + interface_ +
                    ": start tsg-segmentation there with segmentation.input=network, and check the "
                    "link and bus.interface of both";
  } else if (is_silent) {
    state.problem = "the other host does not answer: check the link on interface " + interface_ +
                    " and tsg-segmentation there";
  }
  return state;
}

RelayNode::Counted RelayNode::count_up() {
  const std::scoped_lock lock(mutex_);
  return {.counters = counters_, .model_name = model_name_};
}

/// Left unread by us, dropped by the bus, and not sent.
std::uint64_t RelayNode::passed_over() const {
  return frames_.passed_over() + frames_.missed() + no_room_;
}

std::string RelayNode::report() {
  const Counted counted = count_up();
  nlohmann::json report = counted.counters.to_json();
  report["provider"] = counted.model_name;
  report["passed_over"] = passed_over();
  for (const auto& [key, value] : state().values) report[key] = value;
  return report.dump();
}

}  // namespace tsg
