#include "services/segmentation/node.hpp"

#include <algorithm>
#include <chrono>
#include <iterator>
#include <nlohmann/json.hpp>
#include <opencv2/core/mat.hpp>
#include <stop_token>
#include <utility>

#include "common/bus/convert.hpp"
#include "common/core/time.hpp"
#include "services/segmentation/make_provider.hpp"
#include "services/segmentation/scheduling.hpp"
#include "services/segmentation/waits.hpp"

namespace tsg {

SegmentationNode::SegmentationNode(const SegmentationConfig& config,
                                   Bus& bus,
                                   const ServiceContext& context)
    : context_(context),
      log_(context.log),
      frames_(bus),
      masks_(bus),
      commands_(bus, "segmentation"),
      status_(bus, context.log, "segmentation"),
      faults_text_(to_text(config.faults)),
      faults_(config.faults),
      delayed_(config.faults.late_frames) {
  apply(config.scheduling, log_);
  provider_ = value_or_throw(make_provider(config));
  if (config.uses_shipped_network) {
    log_.warn(
        "the shipped network knows simulated rooms only: for a camera set "
        "segmentation.model.file (docs/models.md)");
  }
  commands_.on("report", [this](const std::string&) -> Expected<std::string> { return report(); });
}

void SegmentationNode::run() {
  const std::stop_callback cancel(context_.stop, [this] { provider_->cancel(); });
  log_.info("masks from", {{"provider", provider_->name()}});
  if (!faults_text_.empty()) {
    log_.warn("masks are made late or wrong on purpose: segmentation.faults is for evaluation only",
              {{"faults", faults_text_}});
  }
  context_.ready();
  while (!context_.stop.stop_requested()) {
    if (const auto message = frames_.take_latest(context_.stop, kFrameWait)) {
      answer(**message);
    } else {
      settle_readers(0, kNoWait);
    }
    commands_.serve_pending();
    if (status_.is_due()) status_.publish(counters_, provider_->name(), passed_over(), state());
    context_.heartbeat();
  }
}

void SegmentationNode::answer(const tsg_RgbdFrame& message) {
  Answer answer{.header = message.header,
                .input_age_ns = monotonic_ns() - message.header.publish_monotonic_ns,
                .result = {}};
  ++counters_.taken;
  counters_.input_age_ms.add(to_milliseconds(answer.input_age_ns));
  const auto answered = faults_text_.empty() ? answer_in_place(message, std::move(answer))
                                             : answer_with_faults(message, std::move(answer));
  if (!answered) withhold(message.header, answered.error());
  publish_due(message.header.seq);
}

Expected<void> SegmentationNode::answer_in_place(const tsg_RgbdFrame& message, Answer answer) {
  const auto frame = view_as_frame(message);
  if (!frame) return tl::unexpected(frame.error());
  auto loan = loan_for_mask();
  if (!loan) return tl::unexpected(loan.error());
  cv::Mat labels(frame->colour.size(), CV_8UC1, (*loan)->labels);
  auto result = provider_->segment(*frame, labels);
  if (context_.stop.stop_requested()) {  // cancelled: nobody waits for this mask any more
    ++counters_.given_up;
    return {};
  }
  if (!result) return tl::unexpected(result.error());
  answer.result = std::move(*result);
  return publish(answer, std::move(*loan));
}

Expected<void> SegmentationNode::answer_with_faults(const tsg_RgbdFrame& message, Answer answer) {
  auto result = segment_with_faults(message);
  if (!result) return tl::unexpected(result.error());
  if (*result) {
    answer.result = std::move(**result);
    counters_.given_up += delayed_.put(message.header.seq, std::move(answer));
  } else {
    ++counters_.given_up;
  }
  return {};
}

Expected<std::optional<SegmentationResult>> SegmentationNode::segment_with_faults(
    const tsg_RgbdFrame& message) {
  if (!faults_.is_segmented(message.header.seq)) return std::nullopt;
  const auto frame = view_as_frame(message);
  if (!frame) return tl::unexpected(frame.error());
  cv::Mat labels;
  auto result = provider_->segment(*frame, labels);
  if (context_.stop.stop_requested()) return std::nullopt;
  if (!result) return tl::unexpected(result.error());
  auto spoilt = faults_.apply(std::move(result->segmentation));
  if (!spoilt) return std::nullopt;
  result->segmentation = std::move(*spoilt);
  return std::optional(std::move(*result));
}

void SegmentationNode::publish_due(std::uint64_t seq) {
  while (const auto due = delayed_.take_due(seq)) {
    const auto published = loan_for_mask().and_then(
        [&](Loan<topics::Instances>&& loan) { return publish(*due, std::move(loan)); });
    if (!published) withhold(due->header, published.error());
  }
}

/// What is published before the first reader is known would be lost to it.
Expected<Loan<topics::Instances>> SegmentationNode::loan_for_mask() {
  settle_readers(has_published_ ? 0 : 1, has_published_ ? kNoWait : kFirstReaderWait);
  has_published_ = true;
  return masks_.loan();
}

Expected<void> SegmentationNode::publish(const Answer& answer, Loan<topics::Instances> loan) {
  tsg_InstanceMask& message = *loan;
  if (auto filled = fill_message(answer.result.segmentation, message); !filled) return filled;
  std::fill(std::begin(message.model_name), std::end(message.model_name), '\0');
  provider_->name().copy(message.model_name, sizeof(message.model_name) - 1);
  message.inference_ns = answer.result.times.total_ns();
  message.input_age_ns = answer.input_age_ns;
  settle_readers(0, kNoWait);  // whoever has come since the loan was taken
  if (auto published = masks_.publish(std::move(loan)); !published) return published;
  counters_.add(answer.result);
  counters_.latency_ms.add(to_milliseconds(monotonic_ns() - answer.header.publish_monotonic_ns));
  return {};
}

void SegmentationNode::withhold(const tsg_Header& header, const Error& why) {
  ++counters_.failed;
  counters_.last_failure = why.message;
  log_.warn("mask withheld",
            {{"seq", header.seq}, {"stamp_ns", header.stamp_ns}, {"why", why.message}});
}

/// What is published before shared memory knows its readers is lost to them, so whoever is new
/// is waited for.
void SegmentationNode::settle_readers(int at_least, std::chrono::milliseconds timeout) {
  masks_.wait_for_subscribers(std::max(masks_.subscriber_count(), at_least), timeout,
                              context_.stop);
}

/// Both were left unread: the first by us, the second by the bus, whose queue is short.
std::uint64_t SegmentationNode::passed_over() const {
  return frames_.passed_over() + frames_.missed();
}

ProviderState SegmentationNode::state() {
  ProviderState state = provider_->state();
  if (faults_text_.empty()) return state;
  state.values.emplace_back("faults", faults_text_);
  if (state.problem.empty()) {
    state.problem = "masks late or wrong on purpose: segmentation.faults is set";
  }
  return state;
}

std::string SegmentationNode::report() const {
  nlohmann::json report = counters_.to_json();
  report["provider"] = provider_->name();
  report["faults"] = faults_text_;
  report["passed_over"] = passed_over();
  return report.dump();
}

}  // namespace tsg
