#include "services/segmentation/node.hpp"

#include <sys/resource.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <iterator>
#include <nlohmann/json.hpp>
#include <stop_token>
#include <system_error>
#include <utility>

#include "common/bus/convert.hpp"
#include "common/core/time.hpp"
#include "services/segmentation/lib/dataset_provider.hpp"

namespace tsg {

namespace {

constexpr std::chrono::milliseconds kFrameWait{100};  // how long commands may lie unanswered
constexpr std::chrono::milliseconds kFirstReaderWait{1000};
constexpr std::chrono::milliseconds kNoWait{0};

/// Lowers the priority of this thread and of all that it starts from now on.
void lower_priority(int nice, Log& log) {
  const int present = ::getpriority(PRIO_PROCESS, 0);
  if (present >= nice) return;
  if (::setpriority(PRIO_PROCESS, 0, nice) != 0) {
    log.warn("priority not lowered", {{"why", std::generic_category().message(errno)}});
  }
}

tl::unexpected<Error> not_set(const std::string& key, const std::string& provider) {
  return make_error(ExitCode::kConfig, "segmentation." + key + " is not set, which provider '" +
                                           provider + "' needs: set it in the configuration or " +
                                           "with --set segmentation." + key + "=PATH");
}

Expected<std::unique_ptr<SegmentationProvider>> make_provider(const SegmentationConfig& config) {
  if (config.provider == "dataset") {
    if (config.dataset_folder.empty()) return not_set("dataset.folder", config.provider);
    return DatasetProvider::make(config.dataset_folder);
  }
  if (config.network.model.file.empty()) return not_set("model.file", config.provider);
  return ModelProvider::make(config.network);
}

std::string with_one_decimal(double value) {
  std::array<char, 32> text{};
  const int length = std::snprintf(text.data(), text.size(), "%.1f", value);
  return {text.data(), static_cast<std::size_t>(length)};
}

}  // namespace

SegmentationNode::SegmentationNode(const SegmentationConfig& config,
                                   Bus& bus,
                                   const ServiceContext& context)
    : context_(context),
      log_(context.log),
      frames_(bus),
      masks_(bus),
      commands_(bus, "segmentation"),
      diagnostics_(bus, "segmentation"),
      faults_text_(to_text(config.faults)),
      faults_(config.faults),
      delayed_(config.faults.late_frames) {
  lower_priority(config.nice, log_);
  provider_ = value_or_throw(make_provider(config));
  commands_.on("report", [this](const std::string&) -> Expected<std::string> { return report(); });
}

void SegmentationNode::run() {
  const std::stop_callback cancel(context_.stop, [this] { provider_->cancel(); });
  log_.info("masks from", {{"provider", provider_->name()}});
  if (!faults_text_.empty()) {
    log_.warn("masks are made late or wrong on purpose: segmentation.faults is for evaluation only",
              {{"faults", faults_text_}});
  }
  reported_at_ns_ = monotonic_ns();
  context_.ready();
  while (!context_.stop.stop_requested()) {
    if (const auto message = frames_.take_latest(context_.stop, kFrameWait)) {
      answer(**message);
    } else {
      settle_readers(0, kNoWait);
    }
    commands_.serve_pending();
    if (diagnostics_.is_due()) publish_diagnostics();
    context_.heartbeat();
  }
}

void SegmentationNode::answer(const tsg_RgbdFrame& message) {
  const std::int64_t published_ns = message.header.publish_monotonic_ns;
  counters_.input_age_ms.add(to_milliseconds(monotonic_ns() - published_ns));
  if (faults_.is_segmented(message.header.seq)) segment_or_withhold(message);
  while (const auto answer = delayed_.take_due(message.header.seq)) publish_or_withhold(*answer);
}

void SegmentationNode::segment_or_withhold(const tsg_RgbdFrame& message) {
  auto result = segment(message);
  if (context_.stop.stop_requested()) return;  // cancelled: nobody waits for this mask any more
  if (!result) {
    withhold(message.header, result.error());
    return;
  }
  auto seen = faults_.apply(std::move(result->segmentation));
  if (!seen) return;
  result->segmentation = std::move(*seen);
  delayed_.put(message.header.seq, {message.header, std::move(*result)});
}

Expected<SegmentationResult> SegmentationNode::segment(const tsg_RgbdFrame& message) {
  const auto frame = view_as_frame(message);
  if (!frame) return tl::unexpected(frame.error());
  return provider_->segment(*frame);
}

void SegmentationNode::publish_or_withhold(const Answer& answer) {
  if (const auto published = publish(answer.result); !published) {
    withhold(answer.header, published.error());
    return;
  }
  counters_.add(answer.result);
  counters_.latency_ms.add(to_milliseconds(monotonic_ns() - answer.header.publish_monotonic_ns));
}

Expected<void> SegmentationNode::publish(const SegmentationResult& result) {
  settle_readers(has_published_ ? 0 : 1, has_published_ ? kNoWait : kFirstReaderWait);
  has_published_ = true;
  auto loan = masks_.loan();
  if (!loan) return tl::unexpected(loan.error());
  tsg_InstanceMask& message = **loan;
  if (auto filled = fill_message(result.segmentation, message); !filled) return filled;
  std::fill(std::begin(message.model_name), std::end(message.model_name), '\0');
  provider_->name().copy(message.model_name, sizeof(message.model_name) - 1);
  message.inference_ns = result.times.total_ns();
  return masks_.publish(std::move(*loan));
}

void SegmentationNode::withhold(const tsg_Header& header, const Error& why) {
  ++counters_.failed;
  log_.warn("mask withheld",
            {{"seq", header.seq}, {"stamp_ns", header.stamp_ns}, {"why", why.message}});
}

/// What is published before shared memory knows its readers is lost to them, so whoever is new
/// is waited for.
void SegmentationNode::settle_readers(int at_least, std::chrono::milliseconds timeout) {
  masks_.wait_for_subscribers(std::max(masks_.subscriber_count(), at_least), timeout,
                              context_.stop);
}

void SegmentationNode::publish_diagnostics() {
  const std::int64_t now_ns = monotonic_ns();
  const double elapsed_s = to_seconds(now_ns - std::exchange(reported_at_ns_, now_ns));
  const std::uint64_t frames = counters_.frames - reported_frames_;
  const std::uint64_t failed = counters_.failed - reported_failed_;
  reported_frames_ = counters_.frames;
  reported_failed_ = counters_.failed;

  Diagnostic diagnostic;
  const bool is_faulty = !faults_text_.empty();
  diagnostic.level = failed > 0 || is_faulty ? DiagnosticLevel::kWarn : DiagnosticLevel::kOk;
  diagnostic.message = failed > 0   ? "masks withheld: see the log"
                       : is_faulty  ? "masks late or wrong on purpose: segmentation.faults is set"
                       : frames > 0 ? "segmenting"
                                    : "waiting for frames";
  const double rate_hz = elapsed_s > 0.0 ? static_cast<double>(frames) / elapsed_s : 0.0;
  const Summary inference = counters_.total_ms.summary();
  const Summary latency = counters_.latency_ms.summary();
  diagnostic.values = {{"provider", provider_->name()},
                       {"faults", faults_text_},
                       {"rate_hz", with_one_decimal(rate_hz)},
                       {"frames", std::to_string(counters_.frames)},
                       {"passed_over", std::to_string(frames_.passed_over() + frames_.missed())},
                       {"failed", std::to_string(counters_.failed)},
                       {"inference_p50_ms", with_one_decimal(inference.median)},
                       {"inference_p99_ms", with_one_decimal(inference.p99)},
                       {"latency_p50_ms", with_one_decimal(latency.median)},
                       {"latency_p99_ms", with_one_decimal(latency.p99)}};
  if (const auto published = diagnostics_.publish(diagnostic); !published) {
    log_.warn("diagnostics not published", {{"why", published.error().message}});
  }
}

std::string SegmentationNode::report() const {
  nlohmann::json report = counters_.to_json();
  report["provider"] = provider_->name();
  report["faults"] = faults_text_;
  // Both were left unread: the first by us, the second by the bus, whose queue is short.
  report["passed_over"] = frames_.passed_over() + frames_.missed();
  return report.dump();
}

}  // namespace tsg
