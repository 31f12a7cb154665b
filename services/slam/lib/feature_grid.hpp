#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace tsg {

struct Feature;

/// Finds the features near a pixel without looking at all of them.
class FeatureGrid {
 public:
  /// Pixels: the usual search radius; a search touches about 9 cells.
  static constexpr int kCellSize = 10;

  FeatureGrid() = default;
  /// Features outside the image (undistortion moves some there) are filed in the border cells.
  FeatureGrid(const std::vector<Feature>& features, int width, int height);

  /// Calls `visit(index)` for each feature filed in a cell that the square of half size `radius`
  /// around `centre` touches: candidates, the caller measures their distance. Ordered by cell,
  /// then index.
  template <typename Visit>
  void for_each_near(const Eigen::Vector2f& centre, float radius, Visit&& visit) const {
    if (starts_.empty()) return;
    const std::size_t first_column = column_of(centre.x() - radius);
    const std::size_t last_column = column_of(centre.x() + radius);
    const std::size_t last_row = row_of(centre.y() + radius);
    for (std::size_t row = row_of(centre.y() - radius); row <= last_row; ++row) {
      const std::uint32_t begin = starts_[row * columns_ + first_column];
      const std::uint32_t end = starts_[row * columns_ + last_column + 1];
      for (std::uint32_t i = begin; i < end; ++i) visit(static_cast<int>(order_[i]));
    }
  }

 private:
  [[nodiscard]] static std::size_t cell_at(float coordinate, std::size_t cells) {
    const float cell = std::max(0.0F, coordinate / static_cast<float>(kCellSize));
    return std::min(static_cast<std::size_t>(cell), cells - 1);
  }
  [[nodiscard]] std::size_t column_of(float x) const { return cell_at(x, columns_); }
  [[nodiscard]] std::size_t row_of(float y) const { return cell_at(y, rows_); }

  std::size_t columns_ = 0;
  std::size_t rows_ = 0;
  std::vector<std::uint32_t> starts_;  ///< per cell, where its features begin in order_
  std::vector<std::uint16_t> order_;   ///< feature indices, sorted by cell
};

}  // namespace tsg
