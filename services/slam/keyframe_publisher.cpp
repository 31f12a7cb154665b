#include "services/slam/keyframe_publisher.hpp"

#include "common/bus/convert.hpp"

namespace tsg {
namespace {

Expected<void> fill(const DenseKeyframe& keyframe, tsg_Keyframe& message) {
  return fill_message(keyframe.frame, message).and_then([&]() -> Expected<void> {
    if (!keyframe.segmentation) return {};
    return fill_message(*keyframe.segmentation, message);
  });
}

}  // namespace

Expected<void> KeyframePublisher::publish(const DenseKeyframe& keyframe) {
  auto loan = publisher_.loan();
  if (!loan) return tl::unexpected(loan.error());
  tsg_Keyframe& message = **loan;
  if (auto filled = fill(keyframe, message); !filled) return filled;
  message.header.seq = sent_;
  message.id = sent_;
  message.T_world_camera = to_message(keyframe.T_map_camera);
  auto published = publisher_.publish(std::move(*loan));
  if (published) ++sent_;
  return published;
}

}  // namespace tsg
