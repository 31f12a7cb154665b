#pragma once

#include <string_view>

#include "common/bus/messages.hpp"
#include "services/slam/lib/local_map_snapshot.hpp"
#include "services/slam/lib/tracker.hpp"
#include "services/slam/stage_times.hpp"

namespace tsg {

/// All but the header, which is the frame's.
[[nodiscard]] tsg_TrackingStatus to_message(const TrackResult& result,
                                            const LocalMapSnapshot& map,
                                            const FrameTimes& times);

/// Copies as much of `reason` as the message has room for.
void set_reason(tsg_TrackingStatus& message, std::string_view reason);

[[nodiscard]] const char* to_text(TrackingState state);

}  // namespace tsg
