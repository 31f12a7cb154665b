#pragma once

#include <cstddef>
#include <vector>

namespace tsg {

/// What evaluations report of a set of numbers; all zero where `count` is.
struct Summary {
  std::size_t count = 0;
  double rmse = 0.0;
  double mean = 0.0;
  double median = 0.0;
  double std_dev = 0.0;  ///< of the population
  double min = 0.0;
  double p99 = 0.0;
  double max = 0.0;
};

[[nodiscard]] Summary summarise(std::vector<double> values);

/// The value below which `fraction` (0..1) of the sorted values lie, linearly interpolated.
/// `sorted` must not be empty.
[[nodiscard]] double quantile(const std::vector<double>& sorted, double fraction);

}  // namespace tsg
