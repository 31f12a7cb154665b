#pragma once

#include <cstdint>
#include <string>

#include "services/tsgctl/lib/progress_line.hpp"

namespace tsg {

/// Shows how far a run is, on stderr: a bar that is redrawn in place where that is a terminal, a
/// line every other second where it is a file or a pipe. Not thread-safe: one owner.
class Progress {
 public:
  Progress();
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  Progress(Progress&&) = delete;
  Progress& operator=(Progress&&) = delete;

  /// Shows the state if it is time to; cheap enough for every frame.
  void update(const ProgressState& state);
  /// A line of its own: what the run does now.
  void say(const std::string& text);
  /// Shows the last state and ends the bar; nothing where there was none.
  void finish(const ProgressState& state);

 private:
  void draw(const ProgressState& state);
  void clear_bar();

  bool is_terminal_;
  bool bar_is_shown_ = false;
  std::int64_t shown_at_ns_ = 0;
};

}  // namespace tsg
