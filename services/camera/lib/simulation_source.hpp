#pragma once

#include <cstdint>
#include <memory>

#include "common/simulation/simulator.hpp"
#include "services/camera/lib/frame_source.hpp"

namespace tsg {

/// How many frames of a scene there are.
enum class SceneEnd {
  kStop,  ///< those of its duration
  kGoOn,  ///< no last one: actors go on as they do, the camera stays where its path ends
};

/// Frames of a simulated room. A frame is rendered when it is decoded, so that one that is skipped
/// costs nothing.
class SimulationSource : public FrameSource {
 public:
  /// `start_ns` is the stamp of the first frame, UTC.
  SimulationSource(simulation::Simulator simulator, std::int64_t start_ns, SceneEnd end);

  [[nodiscard]] const SourceInfo& info() const override { return info_; }
  [[nodiscard]] Expected<std::unique_ptr<PendingFrame>> next() override;

 private:
  std::shared_ptr<simulation::Simulator> simulator_;
  std::int64_t start_ns_;
  SceneEnd end_;
  SourceInfo info_;
  int next_ = 0;
};

}  // namespace tsg
