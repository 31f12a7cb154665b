#include "services/camera/decode_ahead.hpp"

#include <opencv2/core/mat.hpp>
#include <utility>

#include "common/bus/convert.hpp"
#include "common/core/check.hpp"
#include "common/core/time.hpp"

namespace tsg {

DecodeAhead::DecodeAhead(const SourceInfo& info, std::size_t capacity)
    : info_(info),
      capacity_(capacity),
      submitted_(capacity, WhenFull::kBlock),
      decoded_(capacity, WhenFull::kBlock),
      thread_([this](const std::stop_token& stop) { run(stop); }) {}

void DecodeAhead::submit(FrameInFlight frame) {
  TSG_CHECK(in_flight_ < capacity_);
  ++in_flight_;
  submitted_.push(std::move(frame));
}

std::optional<FrameInFlight> DecodeAhead::take(const std::stop_token& stop) {
  TSG_CHECK(in_flight_ > 0);
  auto frame = decoded_.pop(stop);
  if (frame) --in_flight_;
  return frame;
}

void DecodeAhead::run(const std::stop_token& stop) {
  while (auto frame = submitted_.pop(stop)) {
    if (stop.stop_requested()) return;  // what is left goes back to the pool undecoded
    decode(*frame);
    decoded_.push(std::move(*frame), stop);
  }
}

void DecodeAhead::decode(FrameInFlight& frame) const {
  Stopwatch stopwatch;
  tsg_RgbdFrame& message = *frame.loan;
  const int width = info_.camera.width;
  const int height = info_.camera.height;
  RgbdFrame view;
  view.seq = frame.seq;
  view.stamp_ns = frame.frame->stamp_ns();
  view.camera = info_.camera;
  view.depth_units_per_metre = info_.depth_units_per_metre;
  view.colour = cv::Mat(height, width, CV_8UC3, message.colour);
  view.depth = cv::Mat(height, width, CV_16UC1, message.depth);
  frame.decoded = frame.frame->decode(view.colour, view.depth).and_then([&] {
    return fill_message(view, message);  // the images are where they belong and stay there
  });
  frame.decode_ns = stopwatch.lap_ns();
}

}  // namespace tsg
