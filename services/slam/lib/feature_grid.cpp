#include "services/slam/lib/feature_grid.hpp"

#include <algorithm>

#include "services/slam/lib/features.hpp"

namespace tsg {
namespace {

constexpr int kCellSize = 10;  // pixels: the usual search radius; a search touches about 9 cells

std::size_t cells_along(int pixels) {
  return static_cast<std::size_t>((pixels + kCellSize - 1) / kCellSize);
}

std::size_t cell_at(float coordinate, std::size_t cells) {
  const float cell = std::max(0.0F, coordinate / static_cast<float>(kCellSize));
  return std::min(static_cast<std::size_t>(cell), cells - 1);
}

}  // namespace

FeatureGrid::FeatureGrid(const std::vector<Feature>& features, int width, int height)
    : columns_(cells_along(width)), rows_(cells_along(height)) {
  const auto cell_of = [this](const Feature& feature) {
    return row_of(feature.pixel.y()) * columns_ + column_of(feature.pixel.x());
  };
  starts_.assign(columns_ * rows_ + 1, 0);
  for (const Feature& feature : features) ++starts_[cell_of(feature) + 1];
  for (std::size_t cell = 1; cell < starts_.size(); ++cell) starts_[cell] += starts_[cell - 1];
  order_.resize(features.size());
  std::vector<std::uint32_t> next(starts_.begin(), starts_.end() - 1);
  for (std::size_t i = 0; i < features.size(); ++i) {
    order_[next[cell_of(features[i])]++] = static_cast<std::uint16_t>(i);
  }
}

std::size_t FeatureGrid::column_of(float x) const { return cell_at(x, columns_); }
std::size_t FeatureGrid::row_of(float y) const { return cell_at(y, rows_); }

}  // namespace tsg
