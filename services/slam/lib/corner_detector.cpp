#include "services/slam/lib/corner_detector.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <opencv2/features2d.hpp>
#include <utility>

#include "common/core/check.hpp"

namespace tsg {
namespace {

constexpr int kTile = 48;        // pixels; about as large as the gaps that hurt tracking
constexpr int kBareCorners = 2;  // a tile with fewer is searched again with less contrast
constexpr int kFastRadius = 3;   // FAST reads a circle of this radius

struct Ranked {
  std::uint64_t order;  ///< the stronger, then the higher up and the further left, the smaller
  std::size_t index;

  /// By rows, then from left to right.
  [[nodiscard]] std::uint32_t place() const { return static_cast<std::uint32_t>(order); }
};

/// Everything that decides about a corner in one number. Of positive floats the larger one has the
/// larger bits, too.
std::uint64_t order_of(const cv::KeyPoint& corner) {
  const std::uint64_t weakness = ~std::bit_cast<std::uint32_t>(corner.response);
  const auto y = static_cast<std::uint64_t>(corner.pt.y);
  const auto x = static_cast<std::uint64_t>(corner.pt.x);
  return weakness << 32U | y << 16U | x;
}

/// All corners, by strength within their cells.
struct RankedCells {
  std::vector<Ranked> corners;     ///< cell after cell
  std::vector<std::size_t> begin;  ///< of each cell in `corners`, and the end of the last
};

/// Sorting the few of a cell is much faster than sorting all.
RankedCells by_cell(const std::vector<cv::KeyPoint>& corners, int columns, int rows, int side) {
  std::vector<std::size_t> cell_of(corners.size());
  std::transform(corners.begin(), corners.end(), cell_of.begin(), [&](const auto& corner) {
    const auto y = static_cast<unsigned>(corner.pt.y);
    const auto x = static_cast<unsigned>(corner.pt.x);
    const auto cell = static_cast<unsigned>(side);
    return y / cell * static_cast<unsigned>(columns) + x / cell;
  });
  const auto cells = static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows);
  RankedCells ranked{.corners = std::vector<Ranked>(corners.size()),
                     .begin = std::vector<std::size_t>(cells + 1, 0)};
  for (const std::size_t cell : cell_of) ++ranked.begin[cell + 1];
  std::partial_sum(ranked.begin.begin(), ranked.begin.end(), ranked.begin.begin());
  std::vector<std::size_t> next(ranked.begin.begin(), ranked.begin.end() - 1);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    ranked.corners[next[cell_of[i]]++] = {order_of(corners[i]), i};
  }
  for (std::size_t cell = 0; cell < cells; ++cell) {
    const auto first = ranked.corners.begin();
    std::ranges::sort(first + static_cast<std::ptrdiff_t>(ranked.begin[cell]),
                      first + static_cast<std::ptrdiff_t>(ranked.begin[cell + 1]), {},
                      &Ranked::order);
  }
  return ranked;
}

/// The first of each cell, then the second of each, until there are `wanted`: of those that come
/// last the strongest.
std::vector<Ranked> take_in_turn(const RankedCells& ranked, std::size_t wanted) {
  std::vector<Ranked> taken;
  for (std::size_t rank = 0; taken.size() < wanted; ++rank) {
    const auto round = static_cast<std::ptrdiff_t>(taken.size());
    for (std::size_t cell = 0; cell + 1 < ranked.begin.size(); ++cell) {
      const std::size_t i = ranked.begin[cell] + rank;
      if (i < ranked.begin[cell + 1]) taken.push_back(ranked.corners[i]);
    }
    if (taken.size() <= wanted) continue;
    std::ranges::nth_element(taken.begin() + round,
                             taken.begin() + static_cast<std::ptrdiff_t>(wanted), taken.end(), {},
                             &Ranked::order);
    taken.resize(wanted);
  }
  return taken;
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
  std::vector<Ranked> taken =
      take_in_turn(by_cell(corners, columns, rows, cell), static_cast<std::size_t>(wanted));
  std::ranges::sort(taken, {}, &Ranked::place);
  std::vector<cv::KeyPoint> kept;
  kept.reserve(taken.size());
  for (const Ranked& corner : taken) kept.push_back(corners[corner.index]);
  corners = std::move(kept);
}

}  // namespace tsg
