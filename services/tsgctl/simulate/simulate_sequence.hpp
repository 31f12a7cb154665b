#pragma once

#include <filesystem>
#include <functional>

#include "common/core/error.hpp"
#include "common/simulation/simulator.hpp"

namespace tsg {

/// Renders the first `frames` frames of a scene into a new folder in TUM layout. Images are
/// compressed and written on a second thread beside the rendering. `on_frame` is told how many are
/// rendered. Errors are those of SequenceWriter.
[[nodiscard]] Expected<void> simulate_sequence(simulation::Simulator& simulator,
                                               int frames,
                                               const std::filesystem::path& folder,
                                               const std::function<void(int)>& on_frame);

}  // namespace tsg
