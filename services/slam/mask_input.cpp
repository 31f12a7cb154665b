#include "services/slam/mask_input.hpp"

#include "common/bus/convert.hpp"

namespace tsg {

bool MaskInput::update() {
  const std::uint64_t before = received_;
  while (const auto sample = masks_.try_take()) accept(**sample);
  return received_ != before;
}

bool MaskInput::wait_for(std::uint64_t seq,
                         std::chrono::milliseconds timeout,
                         const std::stop_token& stop) {
  const auto deadline = std::chrono::steady_clock::now() + timeout;
  while (!newest_ || newest_->frame_seq != seq) {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(
        deadline - std::chrono::steady_clock::now());
    if (left.count() <= 0) return false;
    const auto sample = masks_.take(stop, left);
    if (!sample) return false;
    accept(**sample);
  }
  return true;
}

void MaskInput::accept(const tsg_InstanceMask& message) {
  auto view = view_as_instances(message);
  if (!view) {
    ++rejected_;
    return;
  }
  cv::Mat memory = newest_ ? newest_->labels : cv::Mat();
  view->labels.copyTo(memory);
  view->labels = memory;
  newest_ = std::move(*view);
  ++received_;
}

}  // namespace tsg
