#include "services/slam/lib/feature_grid.hpp"

#include <algorithm>

#include "services/slam/lib/features.hpp"

namespace tsg {
namespace {

constexpr int kCellSize = 10;  // pixels: the usual search radius; a search touches about 9 cells

}  // namespace

FeatureGrid::FeatureGrid(const std::vector<Feature>& features, int width, int height)
    : columns_((width + kCellSize - 1) / kCellSize), rows_((height + kCellSize - 1) / kCellSize) {
  const auto cell_of = [this](const Feature& feature) {
    return static_cast<std::size_t>(row_of(feature.pixel.y()) * columns_ +
                                    column_of(feature.pixel.x()));
  };
  starts_.assign(static_cast<std::size_t>(columns_ * rows_) + 1, 0);
  for (const Feature& feature : features) ++starts_[cell_of(feature) + 1];
  for (std::size_t cell = 1; cell < starts_.size(); ++cell) starts_[cell] += starts_[cell - 1];
  order_.resize(features.size());
  std::vector<std::uint32_t> next(starts_.begin(), starts_.end() - 1);
  for (std::size_t i = 0; i < features.size(); ++i) {
    order_[next[cell_of(features[i])]++] = static_cast<std::uint16_t>(i);
  }
}

int FeatureGrid::column_of(float x) const {
  return std::clamp(static_cast<int>(x) / kCellSize, 0, columns_ - 1);
}

int FeatureGrid::row_of(float y) const {
  return std::clamp(static_cast<int>(y) / kCellSize, 0, rows_ - 1);
}

}  // namespace tsg
