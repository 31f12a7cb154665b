#include "services/map_server/lib/tags/instance_cleaning.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

#include "services/map_server/lib/voxel_key.hpp"

namespace tsg {
namespace {

/// Edge of the cells in which points are joined: twice the voxels of the map, and at a distance
/// twice the depth noise and quantisation of a Kinect (0.0015..0.003 m at 1 m, with z^2).
constexpr float kNearCell_m = 0.04F;
constexpr float kCellGrowth_per_m = 0.004F;
/// Smaller pieces, relative to the biggest, are rims and noise.
constexpr double kMinPieceShare = 0.1;

std::int64_t key_at(std::int64_t x, std::int64_t y, std::int64_t z) {
  return x + kVoxelKeyOffset + ((y + kVoxelKeyOffset) << kVoxelKeyBits) +
         ((z + kVoxelKeyOffset) << (2 * kVoxelKeyBits));
}

/// Half of the 26 neighbours of a cell; the other half has the cell as neighbour.
std::array<std::int64_t, 13> forward_steps() {
  std::array<std::int64_t, 13> steps{};
  std::size_t used = 0;
  for (const std::int64_t dz : {-1, 0, 1}) {
    for (const std::int64_t dy : {-1, 0, 1}) {
      for (const std::int64_t dx : {-1, 0, 1}) {
        const std::int64_t step = key_at(dx, dy, dz) - key_at(0, 0, 0);
        if (step > 0) steps.at(used++) = step;
      }
    }
  }
  return steps;
}

double mean_depth(const Cloud& points) {
  double sum = 0.0;
  double weight = 0.0;
  for (const CloudPoint& point : points) {
    sum += static_cast<double>(point.position.z()) * point.weight;
    weight += point.weight;
  }
  return sum / weight;
}

/// Pieces as a forest: each cell points to another one of its piece, the root to itself.
class Pieces {
 public:
  explicit Pieces(std::size_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
  }
  std::size_t root_of(std::size_t cell) {
    while (parent_[cell] != cell) {
      parent_[cell] = parent_[parent_[cell]];
      cell = parent_[cell];
    }
    return cell;
  }
  void join(std::size_t a, std::size_t b) { parent_[root_of(b)] = root_of(a); }

 private:
  std::vector<std::size_t> parent_;
};

struct Piece {
  double weight = 0.0;
  float nearest_m = 1e9F;
  float farthest_m = 0.0F;
  double depth_sum = 0.0;  ///< times weight
};

/// For each point, the number of the piece that it belongs to.
std::vector<std::size_t> piece_of_points(const Cloud& points, float cell_m) {
  std::vector<std::int64_t> key_of_point;
  key_of_point.reserve(points.size());
  for (const CloudPoint& point : points) {
    const auto cell = [&](int axis) {
      return static_cast<std::int64_t>(std::floor(point.position[axis] / cell_m));
    };
    key_of_point.push_back(key_at(cell(0), cell(1), cell(2)));
  }
  std::vector<std::int64_t> keys = key_of_point;
  std::sort(keys.begin(), keys.end());
  keys.erase(std::unique(keys.begin(), keys.end()), keys.end());

  Pieces pieces(keys.size());
  const auto steps = forward_steps();
  for (std::size_t i = 0; i < keys.size(); ++i) {
    for (const std::int64_t step : steps) {
      const auto found = std::lower_bound(keys.begin(), keys.end(), keys[i] + step);
      if (found == keys.end() || *found != keys[i] + step) continue;
      pieces.join(i, static_cast<std::size_t>(found - keys.begin()));
    }
  }
  std::vector<std::size_t> piece;
  piece.reserve(points.size());
  for (const std::int64_t key : key_of_point) {
    const auto found = std::lower_bound(keys.begin(), keys.end(), key);
    piece.push_back(pieces.root_of(static_cast<std::size_t>(found - keys.begin())));
  }
  return piece;
}

std::vector<Piece> measure(const Cloud& points, const std::vector<std::size_t>& piece_of_point) {
  std::vector<Piece> pieces(1 + *std::max_element(piece_of_point.begin(), piece_of_point.end()));
  for (std::size_t i = 0; i < points.size(); ++i) {
    Piece& piece = pieces[piece_of_point[i]];
    const float depth = points[i].position.z();
    piece.weight += points[i].weight;
    piece.depth_sum += static_cast<double>(depth) * points[i].weight;
    piece.nearest_m = std::min(piece.nearest_m, depth);
    piece.farthest_m = std::max(piece.farthest_m, depth);
  }
  return pieces;
}

}  // namespace

Cloud clean_instance(const Cloud& points) {
  if (points.empty()) return {};
  const auto depth_m = static_cast<float>(mean_depth(points));
  const float cell_m = kNearCell_m + kCellGrowth_per_m * depth_m * depth_m;
  const std::vector<std::size_t> piece_of_point = piece_of_points(points, cell_m);
  const std::vector<Piece> pieces = measure(points, piece_of_point);
  const Piece& biggest =
      *std::max_element(pieces.begin(), pieces.end(),
                        [](const Piece& a, const Piece& b) { return a.weight < b.weight; });
  const auto belongs = [&](const Piece& piece) {
    if (&piece == &biggest) return true;
    if (piece.weight < kMinPieceShare * biggest.weight) return false;
    const double depth = piece.depth_sum / piece.weight;
    return depth >= biggest.nearest_m - 2.0F * cell_m &&
           depth <= biggest.farthest_m + 2.0F * cell_m;
  };
  Cloud cleaned;
  cleaned.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (belongs(pieces[piece_of_point[i]])) cleaned.push_back(points[i]);
  }
  return cleaned;
}

}  // namespace tsg
