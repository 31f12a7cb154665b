#pragma once

#include <cstdint>
#include <string>

namespace tsg {

/// How far a run is.
struct ProgressState {
  std::uint64_t frames_done = 0;
  std::uint64_t frames_total = 0;
  std::string state;       ///< of tracking, or what the run waits for: "tracking", "saving map"
  double elapsed_s = 0.0;  ///< since the first frame
};

/// Frames per second since the first frame; 0 before it.
[[nodiscard]] double frames_per_second(const ProgressState& progress);

/// One line with a bar that fills `columns` characters at most:
/// "[########------------] 104/260  40 %  tracking  29.8 fps  ETA 0:05".
[[nodiscard]] std::string progress_bar(const ProgressState& progress, int columns);

/// The same facts for a log or a pipe: "frame 104/260 (40 %) tracking 29.8 fps ETA 0:05".
[[nodiscard]] std::string progress_text(const ProgressState& progress);

}  // namespace tsg
