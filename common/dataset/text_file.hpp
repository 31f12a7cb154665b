#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "common/core/error.hpp"

namespace tsg {

/// The fields of one line of a text file, separated by blanks.
struct DataLine {
  int number = 0;  ///< in the file, from 1
  std::vector<std::string> fields;
};

/// The whole file; kMissingInput where it is absent or unreadable, naming it and `fix`.
[[nodiscard]] Expected<std::string> read_text_file(const std::filesystem::path& path,
                                                   std::string_view fix);

/// The lines of a TUM text file that hold data: neither blank nor comment (#).
[[nodiscard]] Expected<std::vector<DataLine>> read_data_lines(const std::filesystem::path& path,
                                                              std::string_view fix);

/// "FILE:LINE": how error messages name a place in a file.
[[nodiscard]] std::string place(const std::filesystem::path& path, int line_number);

/// A finite number; kBadData where `text` is no number, kInvalidNumber for NaN and infinity.
/// Messages start with `where`.
[[nodiscard]] Expected<double> parse_number(std::string_view text, const std::string& where);

}  // namespace tsg
