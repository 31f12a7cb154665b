#pragma once

#include <filesystem>

namespace tsg {

struct SimulationOptions {
  int frames = 90;  ///< at 30 Hz
  int width = 640;
  int height = 480;
};

/// Writes a sequence of the made-up room in TUM layout, with true masks and exact poses; the same
/// bytes each time. Throws FatalError (kCannotWrite) naming the file.
void write_simulated_sequence(const std::filesystem::path& folder,
                              const SimulationOptions& options);

}  // namespace tsg
