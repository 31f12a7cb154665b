#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace tsg {

struct Feature;

/// Finds the features near a pixel without looking at all of them.
class FeatureGrid {
 public:
  FeatureGrid() = default;
  /// Features outside the image (undistortion moves some there) are filed in the border cells.
  FeatureGrid(const std::vector<Feature>& features, int width, int height);

  /// Calls `visit(index)` for each feature filed in a cell that the square of half size `radius`
  /// around `centre` touches: candidates, the caller measures their distance. Ordered by cell,
  /// then index.
  template <typename Visit>
  void for_each_near(const Eigen::Vector2f& centre, float radius, Visit&& visit) const {
    if (starts_.empty()) return;
    const int first_column = column_of(centre.x() - radius);
    const int last_column = column_of(centre.x() + radius);
    for (int row = row_of(centre.y() - radius); row <= row_of(centre.y() + radius); ++row) {
      const auto begin = starts_[static_cast<std::size_t>(row * columns_ + first_column)];
      const auto end = starts_[static_cast<std::size_t>(row * columns_ + last_column + 1)];
      for (std::uint32_t i = begin; i < end; ++i) visit(static_cast<int>(order_[i]));
    }
  }

 private:
  [[nodiscard]] int column_of(float x) const;
  [[nodiscard]] int row_of(float y) const;

  int columns_ = 0;
  int rows_ = 0;
  std::vector<std::uint32_t> starts_;  ///< per cell, where its features begin in order_
  std::vector<std::uint16_t> order_;   ///< feature indices, sorted by cell
};

}  // namespace tsg
