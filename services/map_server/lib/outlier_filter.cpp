#include "services/map_server/lib/outlier_filter.hpp"

#include <algorithm>
#include <cmath>
#include <nanoflann.hpp>

namespace tsg {
namespace {

constexpr double kCoarseM = 0.05;
constexpr std::size_t kPointsInLeaf = 10;  // of the search tree

/// A cloud as nanoflann asks for it.
struct SearchedCloud {
  const Cloud& points;

  [[nodiscard]] std::size_t kdtree_get_point_count() const { return points.size(); }
  [[nodiscard]] float kdtree_get_pt(std::size_t index, std::size_t axis) const {
    return points[index].position[static_cast<Eigen::Index>(axis)];
  }
  template <typename Box>
  bool kdtree_get_bbox(Box& /*box*/) const {
    return false;  // let it compute one
  }
};

using SearchTree =
    nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<float, SearchedCloud>,
                                        SearchedCloud,
                                        3,
                                        std::uint32_t>;

/// Of each point to its `neighbours` nearest ones; there must be more points than that.
std::vector<float> mean_distances(const Cloud& cloud, std::size_t neighbours) {
  const SearchedCloud searched{cloud};
  const SearchTree tree(3, searched, nanoflann::KDTreeSingleIndexAdaptorParams(kPointsInLeaf));
  std::vector<std::uint32_t> indices(neighbours + 1);  // the nearest is the point itself
  std::vector<float> squares(neighbours + 1);
  std::vector<float> means;
  means.reserve(cloud.size());
  for (const CloudPoint& point : cloud) {
    tree.knnSearch(point.position.data(), neighbours + 1, indices.data(), squares.data());
    float sum = 0.0F;
    for (const float square : squares) sum += std::sqrt(square);
    means.push_back(sum / static_cast<float>(neighbours));
  }
  return means;
}

double limit_of(const std::vector<float>& distances, const OutlierConfig& config) {
  double sum = 0.0;
  double sum_of_squares = 0.0;
  for (const double distance : distances) {
    sum += distance;
    sum_of_squares += distance * distance;
  }
  const auto count = static_cast<double>(distances.size());
  const double mean = sum / count;
  const double variance = std::max(0.0, sum_of_squares / count - mean * mean);
  return std::max(config.kept_within_m, mean + config.max_sigma * std::sqrt(variance));
}

}  // namespace

std::vector<std::string> OutlierConfig::problems() const {
  std::vector<std::string> found;
  if (neighbours < 0 || neighbours > 100) {
    found.emplace_back("outliers.neighbours must be 0..100 (0: no filter)");
  }
  if (!(max_sigma > 0.0 && max_sigma <= 100.0)) {
    found.emplace_back("outliers.max_sigma must be above 0 and at most 100");
  }
  if (!(kept_within_m >= 0.0 && kept_within_m <= 10.0)) {
    found.emplace_back("outliers.kept_within_m must be 0..10");
  }
  return found;
}

OutlierFilter::OutlierFilter(const OutlierConfig& config) : config_(config), coarse_(kCoarseM) {}

std::size_t OutlierFilter::apply(Cloud& cloud) {
  const auto neighbours = static_cast<std::size_t>(config_.neighbours);
  if (neighbours == 0) return 0;
  const Cloud coarse = voxel_filter(cloud, coarse_);
  if (coarse.size() <= neighbours) return 0;
  const std::vector<float> distances = mean_distances(coarse, neighbours);
  const double limit = limit_of(distances, config_);
  if (std::ranges::none_of(distances, [&](float distance) { return distance > limit; })) return 0;
  return std::erase_if(cloud, [&](const CloudPoint& point) {
    return distances[coarse_.index_of(point.position)] > limit;
  });
}

}  // namespace tsg
