#include "common/dataset/stamp.hpp"

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <limits>

namespace tsg {
namespace {

constexpr int kNanosecondDecimals = 9;

/// A decimal number taken apart: 0.`digits` times ten to the power of `point`.
struct Decimal {
  bool negative = false;
  std::string digits;
  int point = 0;
};

bool is_digit(char character) { return character >= '0' && character <= '9'; }

/// Moves leading digits of `text` to `digits`; how many there were.
int take_digits(std::string_view& text, std::string& digits) {
  const auto* end = std::find_if_not(text.begin(), text.end(), is_digit);
  const auto count = static_cast<std::size_t>(end - text.begin());
  digits.append(text.substr(0, count));
  text.remove_prefix(count);
  return static_cast<int>(count);
}

std::optional<int> parse_exponent(std::string_view text) {
  text.remove_prefix(1);  // the e
  if (text.starts_with('+')) text.remove_prefix(1);
  int exponent = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), exponent);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  if (std::abs(exponent) > 99) return std::nullopt;
  return exponent;
}

std::optional<Decimal> parse_decimal(std::string_view text) {
  Decimal decimal;
  decimal.negative = text.starts_with('-');
  if (text.starts_with('-') || text.starts_with('+')) text.remove_prefix(1);
  decimal.point = take_digits(text, decimal.digits);
  if (text.starts_with('.')) {
    text.remove_prefix(1);
    take_digits(text, decimal.digits);
  }
  if (decimal.digits.empty()) return std::nullopt;
  if (text.empty()) return decimal;
  if (!text.starts_with('e') && !text.starts_with('E')) return std::nullopt;
  const auto exponent = parse_exponent(text);
  if (!exponent) return std::nullopt;
  decimal.point += *exponent;
  return decimal;
}

}  // namespace

std::optional<std::int64_t> parse_stamp_ns(std::string_view seconds) {
  const auto decimal = parse_decimal(seconds);
  if (!decimal) return std::nullopt;
  const auto digit_at = [&](int index) {
    const auto position = static_cast<std::size_t>(index);
    return position < decimal->digits.size() ? decimal->digits[position] - '0' : 0;
  };
  const int whole_digits = decimal->point + kNanosecondDecimals;
  std::int64_t value = 0;
  for (int i = 0; i < whole_digits; ++i) {
    constexpr std::int64_t kMax = std::numeric_limits<std::int64_t>::max();
    if (value > (kMax - 9) / 10) return std::nullopt;
    value = value * 10 + digit_at(i);
  }
  if (whole_digits >= 0 && digit_at(whole_digits) >= 5) ++value;
  return decimal->negative ? -value : value;
}

std::string format_stamp(std::int64_t stamp_ns, StampDecimals decimals) {
  const bool is_rounded = decimals == StampDecimals::kMicroseconds;
  const std::int64_t unit_ns = is_rounded ? 1000 : 1;
  const std::int64_t units_per_second = 1'000'000'000 / unit_ns;
  const std::int64_t units = (std::abs(stamp_ns) + unit_ns / 2) / unit_ns;
  const std::string fraction = std::to_string(units % units_per_second);
  const auto width = static_cast<std::size_t>(decimals);
  std::string text = stamp_ns < 0 && units > 0 ? "-" : "";
  text += std::to_string(units / units_per_second);
  text += '.';
  text.append(width - fraction.size(), '0');
  text += fraction;
  return text;
}

}  // namespace tsg
