#pragma once

#include <memory>
#include <vector>

#include "services/slam/lib/dynamic/dynamic_filter.hpp"
#include "services/slam/lib/features.hpp"

namespace tsg {

/// The features that go on to tracking and mapping.
struct StaticFeatures {
  std::shared_ptr<const Features> features;
  std::vector<int> new_index;  ///< of each that was judged; -1 for those left out
  std::vector<bool> doubtful;  ///< of those that go on: not seen to stand still; empty: none is
};

/// `all` without what was judged dynamic; its surface too is cleared there. `all` itself where
/// nothing was.
[[nodiscard]] StaticFeatures keep_static(const std::shared_ptr<const Features>& all,
                                         const Judgement& judgement,
                                         const CameraModel& camera);

}  // namespace tsg
