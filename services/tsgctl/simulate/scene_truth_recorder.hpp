#pragma once

#include <cstdint>

#include "common/simulation/world/world.hpp"
#include "services/tsgctl/scene_truth/scene_truth.hpp"

namespace tsg {

/// Gathers what is true of the space of a simulated scene, frame by frame. Holds a reference to the
/// world: not to outlive it.
class SceneTruthRecorder {
 public:
  explicit SceneTruthRecorder(const simulation::World& world);

  /// The scene at a frame; in the order of the frames.
  void add_frame(std::int64_t stamp_ns, double time_s);
  [[nodiscard]] SceneTruth& truth() { return truth_; }

 private:
  void add_boxes(std::int64_t stamp_ns, double time_s);

  const simulation::World& world_;
  SceneTruth truth_;
};

}  // namespace tsg
