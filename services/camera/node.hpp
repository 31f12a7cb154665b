#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "common/app/run_service.hpp"
#include "common/bus/bus.hpp"
#include "common/bus/command.hpp"
#include "common/bus/diagnostics.hpp"
#include "common/bus/topics.hpp"
#include "services/camera/camera_statistics.hpp"
#include "services/camera/config.hpp"
#include "services/camera/decode_ahead.hpp"
#include "services/camera/lib/frame_source.hpp"
#include "services/camera/lib/pacing.hpp"

namespace tsg {

/// The service: frames of a source onto tsg/rgbd at their pace (README.md). The thread that calls
/// run() owns everything here; DecodeAhead has a second one.
class CameraNode {
 public:
  /// Throws FatalError (kSizeMismatch) where the source's images do not fit the bus.
  CameraNode(const CameraConfig& config,
             Bus& bus,
             const ServiceContext& context,
             std::unique_ptr<FrameSource> source);

  /// Returns once stopped, or after the last frame. Throws FatalError for a frame that cannot be
  /// read, and kTimeout where subscribers or, in lockstep, slam's answers do not come.
  void run();

 private:
  /// The counts at the last diagnostics.
  struct Reported {
    std::int64_t at_ns = 0;
    std::uint64_t frames_sent = 0;
    std::uint64_t frames_late = 0;
    std::uint64_t frames_dropped_pool = 0;
  };

  [[nodiscard]] bool is_stopped() const { return context_.stop.stop_requested(); }
  void wait_for_peers();
  void wait_for(const std::function<bool()>& is_there, const std::string& whom);
  void announce_next();
  void read_ahead();
  [[nodiscard]] bool is_too_late() const;
  [[nodiscard]] bool submit_pending();
  void wait_for_memory();
  void send_next();
  void send_when_due(FrameInFlight frame);
  void send(FrameInFlight frame);
  void wait_for_answer(std::uint64_t seq);
  void wait_until(std::int64_t deadline_ns);
  void do_chores();
  void publish_diagnostics();

  CameraConfig config_;
  const ServiceContext& context_;
  Log log_;
  std::unique_ptr<FrameSource> source_;
  Publisher<topics::Rgbd> frames_;
  Subscriber<topics::TrackingStatus> answers_;
  CommandServer commands_;
  DiagnosticsPublisher diagnostics_;
  DecodeAhead decoder_;  // after frames_: its loans go first

  std::optional<ReplayPacer> pacer_;       // from the first frame on; realtime only
  std::unique_ptr<PendingFrame> pending_;  // announced, not yet being decoded; null at the end
  std::uint64_t pending_seq_ = 0;
  std::uint64_t next_seq_ = 0;
  std::int64_t usual_decode_ns_ = 0;  // of late
  CameraStatistics statistics_;
  Reported reported_;
};

}  // namespace tsg
