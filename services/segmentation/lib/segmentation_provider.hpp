#pragma once

#include <cstdint>
#include <string>

#include "common/core/error.hpp"
#include "common/rgbd/instances.hpp"
#include "common/rgbd/rgbd_frame.hpp"

namespace tsg {

/// Wall-clock times of one segmentation; the sum is what the frame took.
struct SegmentationTimes {
  std::int64_t preprocess_ns = 0;   ///< image to input tensor, or reading the recorded mask
  std::int64_t network_ns = 0;      ///< 0 where there is no network
  std::int64_t postprocess_ns = 0;  ///< tensors or recorded ids to instances

  [[nodiscard]] std::int64_t total_ns() const {
    return preprocess_ns + network_ns + postprocess_ns;
  }
};

struct SegmentationResult {
  InstanceSegmentation segmentation;  ///< labels look into the provider, until its next segment()
  SegmentationTimes times;
  int left_out = 0;  ///< instances beyond kMaxInstances
};

/// Finds the instances of a frame. One owner calls segment(); cancel() may come from any thread.
class SegmentationProvider {
 public:
  SegmentationProvider() = default;
  virtual ~SegmentationProvider() = default;
  SegmentationProvider(const SegmentationProvider&) = delete;
  SegmentationProvider& operator=(const SegmentationProvider&) = delete;
  SegmentationProvider(SegmentationProvider&&) = delete;
  SegmentationProvider& operator=(SegmentationProvider&&) = delete;

  /// The instances of `frame`, with its seq and stamp. An error is about this frame only.
  [[nodiscard]] virtual Expected<SegmentationResult> segment(const RgbdFrame& frame) = 0;

  /// Makes a running segment(), and each one after it, fail soon: the process is to stop.
  virtual void cancel() = 0;

  /// What the masks are attributed to: "dataset" or the model's file name.
  [[nodiscard]] virtual const std::string& name() const = 0;
};

}  // namespace tsg
