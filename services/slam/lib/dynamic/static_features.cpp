#include "services/slam/lib/dynamic/static_features.hpp"

#include <algorithm>
#include <numeric>
#include <opencv2/core.hpp>

#include "services/slam/lib/dynamic/depth_cells.hpp"

namespace tsg {
namespace {

void clear_surface(const cv::Mat& dynamic_cells, Surface& surface) {
  for (int row = 0; row < surface.rows; ++row) {
    for (int column = 0; column < surface.columns; ++column) {
      const cv::Point cell(std::min(column * kSurfaceCell / kCellSide, dynamic_cells.cols - 1),
                           std::min(row * kSurfaceCell / kCellSide, dynamic_cells.rows - 1));
      if (dynamic_cells.at<std::uint8_t>(cell) == 0) continue;
      surface.inverse_depths[surface.index(column, row)] = 0.0F;
    }
  }
}

void count_again(Features& features, int left_out) {
  features.counts.dynamic += left_out;
  features.counts.with_depth = 0;
  features.counts.potentially_dynamic = 0;
  for (const Feature& feature : features.items) {
    if (feature.has_depth()) ++features.counts.with_depth;
    if (feature.verdict != FeatureVerdict::kStatic) ++features.counts.potentially_dynamic;
  }
}

}  // namespace

StaticFeatures keep_static(const std::shared_ptr<const Features>& all,
                           const Judgement& judgement,
                           const CameraModel& camera) {
  StaticFeatures kept{.features = all,
                      .new_index = std::vector<int>(all->size()),
                      .doubtful = judgement.is_doubtful};
  std::iota(kept.new_index.begin(), kept.new_index.end(), 0);
  const bool has_cells =
      !judgement.dynamic_cells.empty() && cv::countNonZero(judgement.dynamic_cells) > 0;
  const auto left_out = std::ranges::count(judgement.is_dynamic, true);
  if (left_out == 0 && !has_cells) return kept;
  auto features = std::make_shared<Features>(*all);
  if (has_cells) clear_surface(judgement.dynamic_cells, features->surface);
  if (left_out > 0) {
    features->items.clear();
    features->descriptors.clear();
    for (std::size_t i = 0; i < all->size(); ++i) {
      kept.new_index[i] = judgement.is_dynamic[i] ? -1 : static_cast<int>(features->items.size());
      if (judgement.is_dynamic[i]) continue;
      features->items.push_back(all->items[i]);
      features->descriptors.push_back(all->descriptors[i]);
      if (!kept.doubtful.empty()) kept.doubtful[features->items.size() - 1] = kept.doubtful[i];
    }
    if (!kept.doubtful.empty()) kept.doubtful.resize(features->size());
    features->grid = FeatureGrid(features->items, camera.width, camera.height);
    count_again(*features, static_cast<int>(left_out));
  }
  kept.features = std::move(features);
  return kept;
}

}  // namespace tsg
