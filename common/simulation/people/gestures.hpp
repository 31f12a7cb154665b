#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "common/simulation/people/posture.hpp"

namespace tsg::simulation {

enum class Gesture { kIdle, kTalk, kWave, kPoint, kType, kPhone };

/// The gesture of that name in a scene; "" is kIdle. Empty for any other word.
[[nodiscard]] std::optional<Gesture> gesture_called(std::string_view name);

struct GestureMoment {
  double time_s = 0.0;
  bool is_seated = false;
  std::uint64_t seed = 0;  ///< of the person: everybody moves in a rhythm of his own
};

/// Breathing, shifting one's weight and looking about: added to a body that stands or sits.
void add_idle_motion(const GestureMoment& moment, Posture& posture);

/// Where one looks while walking: now and then aside.
void add_glances(const GestureMoment& moment, double amount, Posture& posture);

/// Hands, and what goes with them of head and trunk. `posture` stands or sits with its hands
/// anywhere.
void add_gesture(const Skeleton& skeleton,
                 Gesture gesture,
                 const GestureMoment& moment,
                 Posture& posture);

}  // namespace tsg::simulation
