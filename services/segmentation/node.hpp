#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "common/app/run_service.hpp"
#include "common/bus/bus.hpp"
#include "common/bus/command.hpp"
#include "common/bus/topics.hpp"
#include "common/rgbd/frame_delay.hpp"
#include "common/rgbd/mask_faults.hpp"
#include "services/segmentation/config.hpp"
#include "services/segmentation/counters.hpp"
#include "services/segmentation/lib/segmentation_provider.hpp"
#include "services/segmentation/status_publisher.hpp"

namespace tsg {

/// Answers camera frames with their instances, always the newest frame, on one thread: what comes
/// in while a frame is worked on is passed over.
class SegmentationNode {
 public:
  /// Throws FatalError where the provider that `config` names cannot be had. Gives the calling
  /// thread the share of the machine that is configured; `bus` was made before, so that its threads
  /// keep theirs.
  SegmentationNode(const SegmentationConfig& config, Bus& bus, const ServiceContext& context);

  /// Returns once stopped, within one layer of the network.
  void run();

 private:
  /// A mask with what its publication is told with.
  struct Answer {
    tsg_Header header = {};         ///< of the frame
    std::int64_t input_age_ns = 0;  ///< of the frame, when it was taken up
    SegmentationResult result;
  };

  void answer(const tsg_RgbdFrame& message);
  /// The mask is made where it is read from: in shared memory.
  [[nodiscard]] Expected<void> answer_in_place(const tsg_RgbdFrame& message, Answer answer);
  /// The mask is made here, spoilt, kept for as long as it is to be late, and copied.
  [[nodiscard]] Expected<void> answer_with_faults(const tsg_RgbdFrame& message, Answer answer);
  [[nodiscard]] Expected<std::optional<SegmentationResult>> segment_with_faults(
      const tsg_RgbdFrame& message);
  void publish_due(std::uint64_t seq);
  [[nodiscard]] Expected<Loan<topics::Instances>> loan_for_mask();
  [[nodiscard]] Expected<void> publish(const Answer& answer, Loan<topics::Instances> loan);
  void withhold(const tsg_Header& header, const Error& why);
  void settle_readers(int at_least, std::chrono::milliseconds timeout);
  [[nodiscard]] std::uint64_t passed_over() const;
  [[nodiscard]] ProviderState state();
  [[nodiscard]] std::string report() const;

  const ServiceContext& context_;
  Log log_;
  std::unique_ptr<SegmentationProvider> provider_;
  Subscriber<topics::Rgbd> frames_;
  Publisher<topics::Instances> masks_;
  CommandServer commands_;
  StatusPublisher status_;
  SegmentationCounters counters_;
  const std::string faults_text_;
  MaskFaultInjector faults_;
  FrameDelay<Answer> delayed_;
  bool has_published_ = false;
};

}  // namespace tsg
