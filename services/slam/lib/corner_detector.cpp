#include "services/slam/lib/corner_detector.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <opencv2/features2d.hpp>
#include <tuple>

#include "common/core/check.hpp"

namespace tsg {
namespace {

constexpr int kTile = 48;        // pixels; about as large as the gaps that hurt tracking
constexpr int kBareCorners = 2;  // a tile with fewer is searched again with less contrast
constexpr int kFastRadius = 3;   // FAST reads a circle of this radius

struct Ranked {
  int rank;  ///< 0 = strongest of its cell
  float response;
  int y;
  int x;
  std::size_t index;
};

bool comes_first(const Ranked& a, const Ranked& b) {
  return std::tie(a.rank, b.response, a.y, a.x) < std::tie(b.rank, a.response, b.y, b.x);
}

/// All corners, ranked by strength within their cells; cell after cell. Sorting the few of a cell
/// is much faster than sorting all.
template <typename CellOf>
std::vector<Ranked> by_cell(const std::vector<cv::KeyPoint>& corners,
                            std::size_t cells,
                            const CellOf& cell_of) {
  std::vector<std::size_t> ends(cells + 1, 0);
  for (const cv::KeyPoint& corner : corners) ++ends[cell_of(corner) + 1];
  std::partial_sum(ends.begin(), ends.end(), ends.begin());
  std::vector<Ranked> ranked(corners.size());
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const cv::KeyPoint& corner = corners[i];
    ranked[ends[cell_of(corner)]++] = {0, corner.response, static_cast<int>(corner.pt.y),
                                       static_cast<int>(corner.pt.x), i};
  }
  auto first = ranked.begin();
  for (std::size_t cell = 0; cell < cells; ++cell) {
    const auto last = ranked.begin() + static_cast<std::ptrdiff_t>(ends[cell]);
    std::sort(first, last, comes_first);  // by strength: all ranks are 0 so far
    for (auto corner = first; corner != last; ++corner) {
      corner->rank = static_cast<int>(corner - first);
    }
    first = last;
  }
  return ranked;
}

}  // namespace

const std::vector<cv::KeyPoint>& CornerDetector::detect(const cv::Mat& image, int margin) {
  corners_.clear();
  const cv::Rect inside(margin, margin, image.cols - 2 * margin, image.rows - 2 * margin);
  TSG_CHECK(margin >= kFastRadius);
  if (inside.width <= 0 || inside.height <= 0) return corners_;
  // FAST leaves its radius free at the border of what it gets.
  const cv::Rect searched(inside.x - kFastRadius, inside.y - kFastRadius,
                          inside.width + 2 * kFastRadius, inside.height + 2 * kFastRadius);
  cv::FAST(image(searched), corners_, threshold_, true);
  const cv::Point2f offset(static_cast<float>(searched.x), static_cast<float>(searched.y));
  for (cv::KeyPoint& corner : corners_) corner.pt += offset;
  search_bare_tiles(image, inside);
  return corners_;
}

void CornerDetector::search_bare_tiles(const cv::Mat& image, const cv::Rect& inside) {
  const int columns = (inside.width + kTile - 1) / kTile;
  const int rows = (inside.height + kTile - 1) / kTile;
  const int tiles = columns * rows;
  tile_counts_.assign(static_cast<std::size_t>(tiles), 0);
  for (const cv::KeyPoint& corner : corners_) {
    const int column = (static_cast<int>(corner.pt.x) - inside.x) / kTile;
    const int row = (static_cast<int>(corner.pt.y) - inside.y) / kTile;
    const int tile = row * columns + column;
    ++tile_counts_[static_cast<std::size_t>(tile)];
  }
  const cv::Rect inside_with_rim(inside.x - kFastRadius, inside.y - kFastRadius,
                                 inside.width + 2 * kFastRadius, inside.height + 2 * kFastRadius);
  for (int tile = 0; tile < tiles; ++tile) {
    if (tile_counts_[static_cast<std::size_t>(tile)] >= kBareCorners) continue;
    const cv::Rect tile_with_rim(inside.x + tile % columns * kTile - kFastRadius,
                                 inside.y + tile / columns * kTile - kFastRadius,
                                 kTile + 2 * kFastRadius, kTile + 2 * kFastRadius);
    const cv::Rect searched = tile_with_rim & inside_with_rim;
    cv::FAST(image(searched), found_, min_threshold_, true);
    for (cv::KeyPoint& corner : found_) {
      if (corner.response >= static_cast<float>(threshold_)) continue;  // known already
      corner.pt.x += static_cast<float>(searched.x);
      corner.pt.y += static_cast<float>(searched.y);
      corners_.push_back(corner);
    }
  }
}

void keep_spread(std::vector<cv::KeyPoint>& corners, const cv::Size& size, int wanted) {
  if (static_cast<int>(corners.size()) <= wanted) return;
  const double area = static_cast<double>(size.width) * size.height;
  const int cell = std::max(1, static_cast<int>(std::sqrt(area / wanted)));
  const int columns = size.width / cell + 1;
  const int rows = size.height / cell + 1;
  const auto cell_of = [&](const cv::KeyPoint& corner) {
    return static_cast<std::size_t>(static_cast<int>(corner.pt.y) / cell * columns +
                                    static_cast<int>(corner.pt.x) / cell);
  };
  const int cell_count = columns * rows;
  const auto cells = static_cast<std::size_t>(cell_count);
  std::vector<Ranked> ranked = by_cell(corners, cells, cell_of);
  std::nth_element(ranked.begin(), ranked.begin() + wanted, ranked.end(), comes_first);
  ranked.resize(static_cast<std::size_t>(wanted));
  std::sort(ranked.begin(), ranked.end(), [](const Ranked& a, const Ranked& b) {
    return std::tie(a.y, a.x) < std::tie(b.y, b.x);
  });
  std::vector<cv::KeyPoint> kept;
  kept.reserve(ranked.size());
  for (const Ranked& corner : ranked) kept.push_back(corners[corner.index]);
  corners = std::move(kept);
}

}  // namespace tsg
