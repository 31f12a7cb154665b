#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <string>
#include <utility>
#include <vector>

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
  InstanceSegmentation segmentation;  ///< its labels are those that segment() was given
  SegmentationTimes times;
  int left_out = 0;  ///< instances beyond kMaxInstances
};

/// What a provider has to say of itself from time to time, for log and diagnostics.
struct ProviderState {
  std::string problem;  ///< a sentence with the fix; empty where all is as it was configured
  std::vector<std::pair<std::string, std::string>> values;  ///< as in Diagnostic
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

  /// The instances of `frame`, with its seq and stamp. The label image is written into `labels`,
  /// into its own memory where it is of the frame's size and CV_8UC1. An error is about this frame
  /// only.
  [[nodiscard]] virtual Expected<SegmentationResult> segment(const RgbdFrame& frame,
                                                             cv::Mat& labels) = 0;

  /// Makes a running segment(), and each one after it, fail soon: the process is to stop.
  virtual void cancel() = 0;

  /// What the masks are attributed to: "dataset" or the model's file name.
  [[nodiscard]] virtual const std::string& name() const = 0;

  /// May look at files; asked once a second, by the owner.
  [[nodiscard]] virtual ProviderState state() = 0;
};

}  // namespace tsg
