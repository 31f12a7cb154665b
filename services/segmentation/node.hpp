#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>

#include "common/app/run_service.hpp"
#include "common/bus/bus.hpp"
#include "common/bus/command.hpp"
#include "common/bus/diagnostics.hpp"
#include "common/bus/topics.hpp"
#include "common/rgbd/frame_delay.hpp"
#include "common/rgbd/mask_faults.hpp"
#include "services/segmentation/config.hpp"
#include "services/segmentation/counters.hpp"

namespace tsg {

/// Answers camera frames with their instances, always the newest frame, on one thread: what comes
/// in while a frame is worked on is passed over.
class SegmentationNode {
 public:
  /// Throws FatalError where the provider that `config` names cannot be had. Lowers the calling
  /// thread's priority; `bus` was made before, so that its threads keep theirs.
  SegmentationNode(const SegmentationConfig& config, Bus& bus, const ServiceContext& context);

  /// Returns once stopped, within one layer of the network.
  void run();

 private:
  /// A mask with what its publication is told with.
  struct Answer {
    tsg_Header header = {};  ///< of the frame
    SegmentationResult result;
  };

  void answer(const tsg_RgbdFrame& message);
  void segment_or_withhold(const tsg_RgbdFrame& message);
  [[nodiscard]] Expected<SegmentationResult> segment(const tsg_RgbdFrame& message);
  void publish_or_withhold(const Answer& answer);
  [[nodiscard]] Expected<void> publish(const SegmentationResult& result);
  void withhold(const tsg_Header& header, const Error& why);
  void settle_readers(int at_least, std::chrono::milliseconds timeout);
  void publish_diagnostics();
  [[nodiscard]] std::string report() const;

  const ServiceContext& context_;
  Log log_;
  std::unique_ptr<SegmentationProvider> provider_;
  Subscriber<topics::Rgbd> frames_;
  Publisher<topics::Instances> masks_;
  CommandServer commands_;
  DiagnosticsPublisher diagnostics_;
  SegmentationCounters counters_;
  const std::string faults_text_;
  MaskFaultInjector faults_;
  FrameDelay<Answer> delayed_;
  bool has_published_ = false;
  // As of the last diagnostics.
  std::int64_t reported_at_ns_ = 0;
  std::uint64_t reported_frames_ = 0;
  std::uint64_t reported_failed_ = 0;
};

}  // namespace tsg
