#pragma once

#include <filesystem>
#include <functional>
#include <ostream>
#include <string_view>

#include "common/core/error.hpp"

namespace tsg {

/// Writes a file that appears under its name only once it is complete and on the disk: `write`
/// fills a temporary file beside it, which is then renamed. On any failure, a full disk included,
/// nothing is left behind, an older file of that name stays as it was, and the error
/// (kCannotWrite) names the path, the reason and the fix. A path that names a device or a pipe is
/// written in place, since replacing it would destroy it. `write` must not throw; what it cannot
/// write it shows by the state of the stream.
[[nodiscard]] Expected<void> write_file_atomically(const std::filesystem::path& path,
                                                   const std::function<void(std::ostream&)>& write);

/// The same for content that is at hand.
[[nodiscard]] Expected<void> write_file_atomically(const std::filesystem::path& path,
                                                   std::string_view content);

/// Makes a folder and those above it where they are absent; kCannotWrite where that fails.
[[nodiscard]] Expected<void> make_folder(const std::filesystem::path& folder);

}  // namespace tsg
