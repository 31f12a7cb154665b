#pragma once

#include <chrono>

// How long the nodes of this service wait.

namespace tsg {

/// For a frame: so long may commands lie unanswered.
inline constexpr std::chrono::milliseconds kFrameWait{100};
/// For a mask's first reader: what is published before it is known would be lost to it.
inline constexpr std::chrono::milliseconds kFirstReaderWait{1000};
inline constexpr std::chrono::milliseconds kNoWait{0};

}  // namespace tsg
