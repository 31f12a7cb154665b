#include "services/slam/lib/feature_grid.hpp"

#include "services/slam/lib/features.hpp"

namespace tsg {
namespace {

std::size_t cells_along(int pixels) {
  return static_cast<std::size_t>((pixels + FeatureGrid::kCellSize - 1) / FeatureGrid::kCellSize);
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

}  // namespace tsg
