#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "common/core/error.hpp"

namespace tsg {

/// Text as a gnuplot string in single quotes, the quotes included.
[[nodiscard]] std::string gnuplot_text(const std::string& text);

/// Draws a PNG with gnuplot; written atomically. `script_for` gives the gnuplot program, data
/// included, that draws into the file it is given. kUnavailable where gnuplot is not installed or
/// fails, kCannotWrite where `png` cannot be written.
[[nodiscard]] Expected<void> draw_png(
    const std::function<std::string(const std::filesystem::path& picture)>& script_for,
    const std::filesystem::path& png);

}  // namespace tsg
