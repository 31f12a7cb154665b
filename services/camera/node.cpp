#include "services/camera/node.hpp"

#include <algorithm>
#include <condition_variable>
#include <mutex>
#include <string>
#include <utility>

#include "common/core/time.hpp"

namespace tsg {
namespace {

using namespace std::chrono_literals;

constexpr std::chrono::milliseconds kChorePeriod = 100ms;  // how long a command may have to wait
constexpr std::int64_t kRetryNs = 10'000'000;              // between looks for free memory

std::int64_t to_ns(double seconds) { return static_cast<std::int64_t>(seconds * 1e9); }

std::string seconds_text(double seconds) {
  std::string text = std::to_string(seconds);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.ends_with('.')) text.pop_back();
  return text + " s";
}

/// Returns at `deadline_ns` of the monotonic clock, or on stop.
void sleep_until(std::int64_t deadline_ns, const std::stop_token& stop) {
  std::mutex mutex;
  std::condition_variable_any never_notified;
  std::unique_lock lock(mutex);
  const std::chrono::steady_clock::time_point deadline{std::chrono::nanoseconds(deadline_ns)};
  never_notified.wait_until(lock, stop, deadline, [] { return false; });
}

/// The source, if its images fit into a sample.
std::unique_ptr<FrameSource> checked(std::unique_ptr<FrameSource> source) {
  const CameraModel& camera = source->info().camera;
  if (std::int64_t{camera.width} * camera.height <= std::int64_t{tsg_MAX_PIXELS}) return source;
  throw FatalError(
      ExitCode::kSizeMismatch,
      "images of " + std::to_string(camera.width) + "x" + std::to_string(camera.height) +
          " pixels do not fit the bus, which carries " + std::to_string(tsg_MAX_IMAGE_WIDTH) + "x" +
          std::to_string(tsg_MAX_IMAGE_HEIGHT) + "; scale the sequence down");
}

}  // namespace

CameraNode::CameraNode(const CameraConfig& config,
                       Bus& bus,
                       const ServiceContext& context,
                       std::unique_ptr<FrameSource> source)
    : config_(config),
      context_(context),
      log_(context.log),
      source_(checked(std::move(source))),
      frames_(bus),
      answers_(bus),
      commands_(bus, "camera"),
      diagnostics_(bus, "camera"),
      decoder_(source_->info(), static_cast<std::size_t>(config.read_ahead_frames)) {
  commands_.on("report", [this](const std::string&) -> Expected<std::string> {
    return statistics_.to_json().dump();
  });
}

void CameraNode::run() {
  context_.ready();
  wait_for_peers();
  announce_next();
  while (!is_stopped()) {
    read_ahead();
    if (decoder_.in_flight() > 0) {
      send_next();
    } else if (pending_ != nullptr) {
      wait_for_memory();
    } else {
      break;
    }
    do_chores();
  }
  log_.info("frames end", {{"frames_sent", statistics_.frames_sent},
                           {"frames_late", statistics_.frames_late},
                           {"frames_dropped_pool", statistics_.frames_dropped_pool}});
  wait_until(monotonic_ns() + to_ns(config_.drain_s));
}

void CameraNode::wait_for_peers() {
  // slam first: the wait for subscribers gives it time to find our end of its answers, too.
  if (config_.is_lockstep()) {
    wait_for([&] { return answers_.wait_for_publishers(1, kChorePeriod, context_.stop); },
             "slam, whose answers lockstep needs,");
  }
  wait_for(
      [&] {
        return frames_.wait_for_subscribers(config_.wait_for_subscribers, kChorePeriod,
                                            context_.stop);
      },
      std::to_string(config_.wait_for_subscribers) + " subscribers of tsg/rgbd");
}

void CameraNode::wait_for(const std::function<bool()>& is_there, const std::string& whom) {
  const std::int64_t deadline_ns = monotonic_ns() + to_ns(config_.subscriber_timeout_s);
  while (!is_there() && !is_stopped()) {
    do_chores();
    if (monotonic_ns() < deadline_ns) continue;
    throw FatalError(ExitCode::kTimeout,
                     whom + " did not come within " + seconds_text(config_.subscriber_timeout_s) +
                         "; start slam and segmentation (tsgctl status shows who runs), or lower "
                         "camera.wait_for_subscribers");
  }
}

void CameraNode::announce_next() {
  pending_ = value_or_throw(source_->next());
  if (pending_ != nullptr) pending_seq_ = next_seq_++;
}

void CameraNode::read_ahead() {
  const auto capacity = static_cast<std::size_t>(config_.read_ahead_frames);
  while (pending_ != nullptr && decoder_.in_flight() < capacity) {
    if (is_too_late()) {
      ++statistics_.frames_late;  // not worth decoding
    } else if (!submit_pending()) {
      return;
    }
    announce_next();
  }
}

/// Whether the pending frame would be late once it is decoded, after those in flight. A source that
/// cannot keep up, such as a simulation on a slow machine, would else decode nothing but frames
/// that are late then.
bool CameraNode::is_too_late() const {
  if (!pacer_) return false;
  const auto before = static_cast<std::int64_t>(decoder_.in_flight());
  const std::int64_t ready_ns = monotonic_ns() + (before + 1) * usual_decode_ns_;
  return pacer_->timing(pending_->stamp_ns(), ready_ns) == Timing::kLate;
}

bool CameraNode::submit_pending() {
  auto loan = frames_.loan();
  if (!loan) return false;
  decoder_.submit({.seq = pending_seq_, .frame = std::move(pending_), .loan = std::move(*loan)});
  return true;
}

void CameraNode::wait_for_memory() {
  if (pacer_) {
    wait_until(pacer_->due_ns(pending_->stamp_ns()));
    if (!submit_pending()) {
      ++statistics_.frames_dropped_pool;
      log_.warn("frame dropped: no shared memory is free", {{"seq", pending_seq_}});
    }
    announce_next();
    return;
  }
  const std::int64_t deadline_ns = monotonic_ns() + to_ns(config_.lockstep_timeout_s);
  while (!is_stopped() && !submit_pending()) {
    wait_until(monotonic_ns() + kRetryNs);
    if (monotonic_ns() < deadline_ns) continue;
    throw FatalError(ExitCode::kUnavailable,
                     "no shared memory for a frame for " +
                         seconds_text(config_.lockstep_timeout_s) +
                         ": readers of tsg/rgbd keep all of it; look for one that hangs (tsgctl "
                         "status), or enlarge the pool in config/roudi.toml");
  }
  if (!is_stopped()) announce_next();
}

void CameraNode::send_next() {
  auto frame = decoder_.take(context_.stop);
  if (!frame || is_stopped()) return;
  throw_on_error(frame->decoded);
  statistics_.decode_ms.add(to_milliseconds(frame->decode_ns));
  usual_decode_ns_ += (frame->decode_ns - usual_decode_ns_) / 4;
  if (!config_.is_lockstep()) {
    send_when_due(std::move(*frame));
    return;
  }
  const std::uint64_t seq = frame->seq;
  send(std::move(*frame));
  wait_for_answer(seq);
}

void CameraNode::send_when_due(FrameInFlight frame) {
  const std::int64_t stamp_ns = frame.frame->stamp_ns();
  if (!pacer_) pacer_.emplace(stamp_ns, monotonic_ns(), source_->info().fps);
  wait_until(pacer_->due_ns(stamp_ns));
  if (is_stopped()) return;
  const std::int64_t now_ns = monotonic_ns();
  if (pacer_->timing(stamp_ns, now_ns) == Timing::kLate) {
    ++statistics_.frames_late;
    return;
  }
  statistics_.behind_ms.add(to_milliseconds(now_ns - pacer_->due_ns(stamp_ns)));
  send(std::move(frame));
}

void CameraNode::send(FrameInFlight frame) {
  frame.loan->header.publish_monotonic_ns = monotonic_ns();  // not when it was decoded
  throw_on_error(frames_.publish(std::move(frame.loan)));
  ++statistics_.frames_sent;
}

void CameraNode::wait_for_answer(std::uint64_t seq) {
  const std::int64_t deadline_ns = monotonic_ns() + to_ns(config_.lockstep_timeout_s);
  while (!is_stopped()) {
    const auto answer = answers_.take(context_.stop, kChorePeriod);
    if (answer && (*answer)->header.seq == seq) return;
    do_chores();
    if (monotonic_ns() < deadline_ns) continue;
    throw FatalError(ExitCode::kTimeout,
                     "slam has not answered frame " + std::to_string(seq) + " within " +
                         seconds_text(config_.lockstep_timeout_s) +
                         "; look at its log, or raise camera.lockstep_timeout_s");
  }
}

void CameraNode::wait_until(std::int64_t deadline_ns) {
  const std::int64_t chore_period_ns = std::chrono::nanoseconds(kChorePeriod).count();
  for (std::int64_t now_ns = monotonic_ns(); now_ns < deadline_ns && !is_stopped();
       now_ns = monotonic_ns()) {
    do_chores();
    sleep_until(std::min(deadline_ns, now_ns + chore_period_ns), context_.stop);
  }
}

void CameraNode::do_chores() {
  commands_.serve_pending();
  context_.heartbeat();
  if (diagnostics_.is_due()) publish_diagnostics();
}

void CameraNode::publish_diagnostics() {
  const std::int64_t now_ns = monotonic_ns();
  const std::uint64_t sent = statistics_.frames_sent - reported_.frames_sent;
  const bool dropped = statistics_.frames_late > reported_.frames_late ||
                       statistics_.frames_dropped_pool > reported_.frames_dropped_pool;
  const double period_s = std::max(to_seconds(now_ns - reported_.at_ns), 1e-3);
  const Summary decode_ms = statistics_.decode_ms.summary();
  const Diagnostic diagnostic{
      .level = dropped ? DiagnosticLevel::kWarn : DiagnosticLevel::kOk,
      .message = dropped ? "drops frames" : (sent > 0 ? "sends frames" : "waits"),
      .values = {{"rate_hz", std::to_string(static_cast<double>(sent) / period_s)},
                 {"frames_sent", std::to_string(statistics_.frames_sent)},
                 {"frames_late", std::to_string(statistics_.frames_late)},
                 {"frames_dropped_pool", std::to_string(statistics_.frames_dropped_pool)},
                 {"decode_ms_p50", std::to_string(decode_ms.median)},
                 {"decode_ms_p99", std::to_string(decode_ms.p99)}}};
  if (const auto published = diagnostics_.publish(diagnostic); !published) {
    log_.warn("diagnostics not published", {{"why", published.error().message}});
  }
  reported_ = {now_ns, statistics_.frames_sent, statistics_.frames_late,
               statistics_.frames_dropped_pool};
}

}  // namespace tsg
