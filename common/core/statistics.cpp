#include "common/core/statistics.hpp"

#include <algorithm>
#include <cmath>

#include "common/core/check.hpp"

namespace tsg {

double quantile(const std::vector<double>& sorted, double fraction) {
  TSG_CHECK(!sorted.empty());
  const double position = fraction * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(position);
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  return std::lerp(sorted[below], sorted[above], position - static_cast<double>(below));
}

Summary summarise(std::vector<double> values) {
  Summary summary;
  if (values.empty()) return summary;
  std::sort(values.begin(), values.end());
  const auto count = static_cast<double>(values.size());
  double sum = 0.0;
  double sum_of_squares = 0.0;
  for (const double value : values) {
    sum += value;
    sum_of_squares += value * value;
  }
  summary.count = values.size();
  summary.mean = sum / count;
  summary.rmse = std::sqrt(sum_of_squares / count);
  double sum_of_squared_deviations = 0.0;
  for (const double value : values) {
    sum_of_squared_deviations += (value - summary.mean) * (value - summary.mean);
  }
  summary.std_dev = std::sqrt(sum_of_squared_deviations / count);
  summary.min = values.front();
  summary.max = values.back();
  summary.median = quantile(values, 0.5);
  summary.p99 = quantile(values, 0.99);
  return summary;
}

}  // namespace tsg
