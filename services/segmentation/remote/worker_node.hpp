#pragma once

#include <memory>
#include <string>

#include "common/app/run_service.hpp"
#include "common/bus/bus.hpp"
#include "common/bus/command.hpp"
#include "common/bus/topics.hpp"
#include "services/segmentation/config.hpp"
#include "services/segmentation/counters.hpp"
#include "services/segmentation/lib/segmentation_provider.hpp"
#include "services/segmentation/status_publisher.hpp"

namespace tsg {

/// The other end of RelayNode: answers frames that come over the network with their masks, always
/// the newest one, on one thread.
class RemoteWorkerNode {
 public:
  /// Throws FatalError where the provider that `config` names cannot be had. Gives the calling
  /// thread the share of the machine that is configured.
  RemoteWorkerNode(const SegmentationConfig& config, Bus& bus, const ServiceContext& context);

  /// Returns once stopped, within one layer of the network.
  void run();

 private:
  void answer(const tsg_CompressedColour& message);
  [[nodiscard]] Expected<SegmentationResult> segment(const tsg_CompressedColour& message);
  [[nodiscard]] Expected<void> publish(const tsg_CompressedColour& message,
                                       const SegmentationResult& result);
  [[nodiscard]] std::string report() const;

  const ServiceContext& context_;
  Log log_;
  std::unique_ptr<SegmentationProvider> provider_;
  Subscriber<topics::RemoteColour> frames_;
  Publisher<topics::RemoteMask> masks_;
  CommandServer commands_;
  StatusPublisher status_;
  SegmentationCounters counters_;
};

}  // namespace tsg
