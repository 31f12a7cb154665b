#include "services/slam/keyframe_publisher.hpp"

#include <algorithm>

#include "common/bus/convert.hpp"
#include "common/core/time.hpp"
#include "services/slam/odometry.hpp"

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
  message.T_world_camera = to_message(keyframe.place.T_map_camera);
  auto published = publisher_.publish(std::move(*loan));
  if (!published) return published;
  placed_.push_back({.id = sent_,
                     .stamp_ns = keyframe.frame.stamp_ns,
                     .reference = keyframe.place.reference,
                     .T_reference_camera = keyframe.place.T_reference_camera});
  ++sent_;
  return published;
}

Expected<void> KeyframePublisher::publish_poses(const std::vector<KeyframePose>& corrected) {
  std::vector<tsg_KeyframePose> poses;
  for (const Placed& placed : placed_) {
    const auto reference =
        std::lower_bound(corrected.begin(), corrected.end(), placed.reference,
                         [](const KeyframePose& pose, KeyframeId id) { return pose.id < id; });
    if (reference == corrected.end() || reference->id != placed.reference) continue;
    const SE3 T_world_camera = reference->T_world_camera * placed.T_reference_camera;
    poses.push_back({.id = placed.id,
                     .stamp_ns = placed.stamp_ns,
                     .T_world_camera = to_message(Odometry::T_map_world() * T_world_camera)});
  }
  topics::KeyframePoses::Message message{};
  message.header.seq = corrections_++;
  message.header.stamp_ns = poses.empty() ? 0 : poses.back().stamp_ns;
  message.header.publish_monotonic_ns = monotonic_ns();
  lend(poses, message.keyframes);
  return poses_.publish(message);
}

}  // namespace tsg
