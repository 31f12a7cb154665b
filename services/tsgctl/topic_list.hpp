#pragma once

#include <string>
#include <vector>

#include "common/bus/topics.hpp"
#include "common/core/error.hpp"

namespace tsg {

namespace detail {

/// Calls visit.operator()<Topic>() for every topic, in the order of the data flow.
template <typename Visitor>
void for_each_topic(Visitor visit) {
  const auto visit_all = [&visit]<typename... Topics>() {
    (visit.template operator()<Topics>(), ...);
  };
  visit_all.template operator()<
      topics::Rgbd, topics::Instances, topics::TrackingStatus, topics::Pose, topics::Odometry,
      topics::Transforms, topics::Keyframe, topics::KeyframePoses, topics::Octomap, topics::Objects,
      topics::Cloud, topics::Grid, topics::Diagnostics, topics::Command, topics::Reply>();
}

}  // namespace detail

[[nodiscard]] std::vector<std::string> topic_names();

/// Throws FatalError (kUsage) listing the topics that there are.
[[noreturn]] void throw_unknown_topic(const std::string& name);

/// Calls visit.operator()<Topic>() for the topic of that name; throws FatalError (kUsage) where
/// there is none.
template <typename Visitor>
void with_topic(const std::string& name, Visitor visit) {
  bool found = false;
  detail::for_each_topic([&]<typename Topic>() {
    if (name != Topic::kName) return;
    found = true;
    visit.template operator()<Topic>();
  });
  if (!found) throw_unknown_topic(name);
}

}  // namespace tsg
