#pragma once

#include "common/bus/messages.hpp"
#include "common/core/error.hpp"
#include "services/map_server/lib/keyframe.hpp"

namespace tsg {

/// A keyframe with memory of its own, as large as its images, so that the sample can go back to
/// the shared pool at once. kBadData or kInvalidNumber where the message makes no sense.
[[nodiscard]] Expected<MapKeyframe> copy_keyframe(const tsg_Keyframe& message);

}  // namespace tsg
