#pragma once

#include <cstdint>
#include <memory>
#include <opencv2/core/mat.hpp>

#include "common/core/error.hpp"
#include "common/geometry/camera_model.hpp"

namespace tsg {

/// What all frames of a source have in common.
struct SourceInfo {
  CameraModel camera;
  double depth_units_per_metre = 1000.0;
  double fps = 30.0;
};

/// A frame that is known to be there; its pixels are not decoded yet. Any one thread may own it.
class PendingFrame {
 public:
  PendingFrame() = default;
  virtual ~PendingFrame() = default;
  PendingFrame(const PendingFrame&) = delete;
  PendingFrame& operator=(const PendingFrame&) = delete;
  PendingFrame(PendingFrame&&) = delete;
  PendingFrame& operator=(PendingFrame&&) = delete;

  /// Capture time, UTC.
  [[nodiscard]] virtual std::int64_t stamp_ns() const = 0;

  /// Writes the pixels into memory of the caller: `colour` CV_8UC3 (BGR), `depth` CV_16UC1, both of
  /// the camera's size.
  [[nodiscard]] virtual Expected<void> decode(const cv::Mat& colour,
                                              const cv::Mat& depth) const = 0;
};

/// Where frames come from: a recording or a sensor. One thread owns it.
class FrameSource {
 public:
  FrameSource() = default;
  virtual ~FrameSource() = default;
  FrameSource(const FrameSource&) = delete;
  FrameSource& operator=(const FrameSource&) = delete;
  FrameSource(FrameSource&&) = delete;
  FrameSource& operator=(FrameSource&&) = delete;

  [[nodiscard]] virtual const SourceInfo& info() const = 0;

  /// The next frame, stamps ascending; null after the last.
  [[nodiscard]] virtual Expected<std::unique_ptr<PendingFrame>> next() = 0;
};

}  // namespace tsg
