#pragma once

#include <cstddef>
#include <vector>

#include "common/core/statistics.hpp"

namespace tsg {

/// The newest `capacity` of the numbers added: statistics of a service that runs for weeks.
class SampleWindow {
 public:
  explicit SampleWindow(std::size_t capacity = kDefaultCapacity) : capacity_(capacity) {}

  void add(double value) {
    if (values_.size() < capacity_) {
      values_.push_back(value);
    } else {
      values_[next_] = value;
      next_ = (next_ + 1) % capacity_;
    }
  }

  [[nodiscard]] Summary summary() const { return summarise(values_); }
  [[nodiscard]] std::size_t size() const { return values_.size(); }

 private:
  static constexpr std::size_t kDefaultCapacity = 20'000;  // ten minutes at 30 Hz

  std::size_t capacity_;
  std::size_t next_ = 0;  // to be overwritten, once full
  std::vector<double> values_;
};

}  // namespace tsg
