#include "common/dataset/text_file.hpp"

#include <charconv>
#include <cmath>
#include <fstream>
#include <iterator>
#include <sstream>
#include <system_error>

namespace tsg {

Expected<std::string> read_text_file(const std::filesystem::path& path, std::string_view fix) {
  const auto missing = [&](const char* what) {
    return make_error(ExitCode::kMissingInput,
                      std::string(what) + " " + path.string() + "; " + std::string(fix));
  };
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored)) return missing("there is no file");
  std::ifstream file(path, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(file), {}};
  if (!file) return missing("cannot read");
  return text;
}

Expected<std::vector<DataLine>> read_data_lines(const std::filesystem::path& path,
                                                std::string_view fix) {
  const auto text = read_text_file(path, fix);
  if (!text) return tl::unexpected(text.error());
  std::vector<DataLine> lines;
  std::istringstream stream(*text);
  int number = 0;
  for (std::string line; std::getline(stream, line);) {
    ++number;
    std::istringstream words(line);
    DataLine data{
        number, {std::istream_iterator<std::string>(words), std::istream_iterator<std::string>()}};
    if (!data.fields.empty() && !data.fields.front().starts_with('#')) {
      lines.push_back(std::move(data));
    }
  }
  return lines;
}

std::string place(const std::filesystem::path& path, int line_number) {
  return path.string() + ":" + std::to_string(line_number);
}

Expected<double> parse_number(std::string_view text, const std::string& where) {
  std::string_view digits = text;
  if (digits.starts_with('+')) digits.remove_prefix(1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error != std::errc() || end != digits.data() + digits.size()) {
    return make_error(ExitCode::kBadData,
                      where + ": \"" + std::string(text) + "\" is not a number; correct the line");
  }
  if (!std::isfinite(value)) {
    return make_error(ExitCode::kInvalidNumber,
                      where + ": \"" + std::string(text) +
                          "\" is not a finite number; remove the line or record anew");
  }
  return value;
}

}  // namespace tsg
