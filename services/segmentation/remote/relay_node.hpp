#pragma once

#include <cstdint>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>

#include "common/app/run_service.hpp"
#include "common/bus/bus.hpp"
#include "common/bus/command.hpp"
#include "common/bus/topics.hpp"
#include "services/segmentation/config.hpp"
#include "services/segmentation/counters.hpp"
#include "services/segmentation/lib/remote/frames_under_way.hpp"
#include "services/segmentation/lib/segmentation_provider.hpp"
#include "services/segmentation/status_publisher.hpp"

namespace tsg {

/// Has camera frames segmented by another host: sends the newest one, compressed, whenever that
/// host has room for one, and publishes the masks that come back as if they were made here. Where
/// the link is gone, frames are passed over and nobody waits.
class RelayNode {
 public:
  /// Gives the calling thread, and the one that run() starts, the share of the machine that is
  /// configured.
  RelayNode(const SegmentationConfig& config, Bus& bus, const ServiceContext& context);

  /// Returns once stopped.
  void run();

 private:
  // The thread of run(): frames out.
  void relay(const tsg_RgbdFrame& message);
  [[nodiscard]] Expected<void> send(const tsg_RgbdFrame& message);
  [[nodiscard]] ProviderState state();
  struct Counted {
    SegmentationCounters counters;
    std::string model_name;
  };
  [[nodiscard]] Counted count_up();
  [[nodiscard]] std::uint64_t passed_over() const;
  [[nodiscard]] std::string report();

  // A thread of its own: masks in.
  void return_masks(const std::stop_token& stop);
  [[nodiscard]] Expected<void> publish(const tsg_CompressedMask& answer, const SentFrame& frame);
  [[nodiscard]] Expected<Loan<topics::Instances>> loan_for_mask();
  void settle_readers();
  void count(const tsg_CompressedMask& answer, const SentFrame& frame, std::int64_t decoding_ns);

  void withhold(std::uint64_t seq, const Error& why);

  const RemoteConfig config_;
  const std::string interface_;
  const ServiceContext& context_;
  Log log_;
  Subscriber<topics::Rgbd> frames_;
  Publisher<topics::RemoteColour> colours_;
  CommandServer commands_;
  StatusPublisher status_;
  std::uint64_t no_room_ =
      0;  ///< frames that were not sent, as others were under way or nobody was

  Subscriber<topics::RemoteMask> answers_;  // of the thread of return_masks(), like the next two
  Publisher<topics::Instances> masks_;
  bool has_published_ = false;

  std::mutex mutex_;  // guards all below; held for bookkeeping only
  FramesUnderWay under_way_;
  SegmentationCounters counters_;
  RecentValues round_trip_ms_;  ///< from sending to the answer's arrival
  std::string model_name_ = "remote";
};

}  // namespace tsg
