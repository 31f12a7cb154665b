#include "services/segmentation/lib/decoders/solov2_cells.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

namespace tsg {

namespace {

constexpr float kMinScore = 0.1F;

float sigmoid(float logit) { return 1.0F / (1.0F + std::exp(-logit)); }

/// Whether no cell left of it, above or both has more of this class. SOLOv2 pools 2 x 2 cells with
/// padding at the left and at the top.
bool is_peak(const Solov2Level& level, int cell, int class_id) {
  const float own = sigmoid(level.category(cell, class_id));
  const int x = cell % level.size;
  const int y = cell / level.size;
  for (const auto& [left, up] : {std::pair(1, 0), std::pair(0, 1), std::pair(1, 1)}) {
    if (x < left || y < up) continue;
    if (sigmoid(level.category(cell - left - up * level.size, class_id)) > own) return false;
  }
  return true;
}

}  // namespace

std::vector<Solov2Level> solov2_levels(const Solov2Layout& layout,
                                       std::span<const TensorView> outputs) {
  std::vector<Solov2Level> levels;
  for (const Solov2Grid& grid : layout.grids) {
    const auto cells = static_cast<std::ptrdiff_t>(grid.size) * grid.size;
    const auto first = static_cast<std::ptrdiff_t>(grid.first_cell);
    const std::ptrdiff_t category_step = layout.is_merged ? layout.classes() : 1;
    const std::ptrdiff_t kernel_step = layout.is_merged ? layout.kernel_length : 1;
    levels.push_back({.categories = outputs[grid.categories].floats.data() + first * category_step,
                      .kernels = outputs[grid.kernels].floats.data() + first * kernel_step,
                      .size = grid.size,
                      .stride = grid.stride,
                      .between_cells_of_categories = category_step,
                      .between_classes = layout.is_merged ? 1 : cells,
                      .between_cells_of_kernels = kernel_step,
                      .between_numbers = layout.is_merged ? 1 : cells});
  }
  return levels;
}

std::vector<Solov2Candidate> find_candidates(const Solov2Layout& layout,
                                             std::span<const Solov2Level> levels) {
  // Below it no sigmoid is above kMinScore, whatever rounding does: saves an exponential for each.
  const float min_raw = std::log(kMinScore / (1.0F - kMinScore)) - 1e-3F;
  std::vector<Solov2Candidate> found;
  for (int i = 0; i < static_cast<int>(levels.size()); ++i) {
    const Solov2Level& level = levels[static_cast<std::size_t>(i)];
    for (int class_id = 0; class_id < layout.classes(); ++class_id) {
      for (int cell = 0; cell < level.size * level.size; ++cell) {
        const float value = level.category(cell, class_id);
        if (!(value > (layout.is_merged ? kMinScore : min_raw))) continue;
        const float score = layout.is_merged ? value : sigmoid(value);
        if (!(score > kMinScore)) continue;
        if (!layout.is_merged && !is_peak(level, cell, class_id)) continue;
        found.push_back({i, cell, class_id, score});
      }
    }
  }
  std::sort(found.begin(), found.end(), [](const auto& a, const auto& b) {
    return std::tie(a.level, a.cell, a.class_id) < std::tie(b.level, b.cell, b.class_id);
  });
  return found;
}

}  // namespace tsg
