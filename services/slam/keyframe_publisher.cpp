#include "services/slam/keyframe_publisher.hpp"

#include "common/bus/convert.hpp"
#include "common/core/time.hpp"

namespace tsg {
namespace {

// iceoryx follows a match of DDS within two of its discovery rounds of 100 ms.
constexpr std::chrono::milliseconds kSettleTime{250};

Expected<void> fill(const DenseKeyframe& keyframe, tsg_Keyframe& message) {
  return fill_message(keyframe.frame, message).and_then([&]() -> Expected<void> {
    if (!keyframe.segmentation) return {};
    return fill_message(*keyframe.segmentation, message);
  });
}

}  // namespace

void KeyframePublisher::watch_subscribers() {
  const int present = publisher_.subscriber_count();
  if (present > subscribers_) joined_ns_ = monotonic_ns();
  subscribers_ = present;
}

bool KeyframePublisher::is_settled() const {
  return std::chrono::nanoseconds(monotonic_ns() - joined_ns_) >= kSettleTime;
}

Expected<void> KeyframePublisher::publish(const DenseKeyframe& keyframe) {
  watch_subscribers();
  if (subscribers_ == 0) return {};
  if (!is_settled()) {
    if (sent_ > 0) {
      return make_error(ExitCode::kUnavailable,
                        "a map server is joining just now; it gets the next keyframe");
    }
    // The first one may wait: there is no track yet that it could hold up.
    publisher_.wait_for_subscribers(subscribers_, kSettleTime);
  }
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
