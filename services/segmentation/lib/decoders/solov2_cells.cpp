#include "services/segmentation/lib/decoders/solov2_cells.hpp"

#include <algorithm>
#include <optional>
#include <tuple>

#include "services/segmentation/lib/decoders/sigmoid.hpp"

namespace tsg {

namespace {

constexpr float kMinScore = 0.1F;

/// Whether no cell left of it, above or both has more of this class. SOLOv2 pools 2 x 2 cells with
/// padding at the left and at the top.
bool is_peak(const Solov2Level& level, int cell, int class_id) {
  const float own = sigmoid(level.category(cell, class_id));
  const int x = cell % level.size;
  const int y = cell / level.size;
  const auto is_better = [&](int left, int up) {
    if (x < left || y < up) return false;
    return sigmoid(level.category(cell - left - up * level.size, class_id)) > own;
  };
  return !is_better(1, 0) && !is_better(0, 1) && !is_better(1, 1);
}

/// The score of a class of a cell of raw outputs, if it is a candidate.
std::optional<float> score_of_raw(const Solov2Level& level, int cell, int class_id) {
  // Below it no sigmoid is above kMinScore, whatever rounding does: saves an exponential for each.
  constexpr float kMinLogit = -2.198F;  // log(0.1 / 0.9) = -2.1972
  const float logit = level.category(cell, class_id);
  if (!(logit > kMinLogit)) return std::nullopt;
  const float score = sigmoid(logit);
  if (!(score > kMinScore) || !is_peak(level, cell, class_id)) return std::nullopt;
  return score;
}

/// The same of merged outputs.
std::optional<float> score_of_merged(const Solov2Level& level, int cell, int class_id) {
  const float score = level.category(cell, class_id);
  return score > kMinScore ? std::optional(score) : std::nullopt;
}

/// Those of one level, class by class, as raw outputs lie in memory. A template, since most of the
/// time goes into looking at the hundreds of thousands that are none.
template <bool kIsMerged>
void add_candidates(std::span<const Solov2Level> levels,
                    int index,
                    int classes,
                    std::vector<Solov2Candidate>& found) {
  const Solov2Level& level = levels[static_cast<std::size_t>(index)];
  const int cells = level.size * level.size;
  for (int class_id = 0; class_id < classes; ++class_id) {
    for (int cell = 0; cell < cells; ++cell) {
      const auto score =
          kIsMerged ? score_of_merged(level, cell, class_id) : score_of_raw(level, cell, class_id);
      if (score) found.push_back({index, cell, class_id, *score});
    }
  }
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
  std::vector<Solov2Candidate> found;
  for (int i = 0; i < static_cast<int>(levels.size()); ++i) {
    if (layout.is_merged) {
      add_candidates<true>(levels, i, layout.classes(), found);
    } else {
      add_candidates<false>(levels, i, layout.classes(), found);
    }
  }
  std::sort(found.begin(), found.end(), [](const auto& a, const auto& b) {
    return std::tie(a.level, a.cell, a.class_id) < std::tie(b.level, b.cell, b.class_id);
  });
  return found;
}

}  // namespace tsg
