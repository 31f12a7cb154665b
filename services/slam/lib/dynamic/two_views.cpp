#include "services/slam/lib/dynamic/two_views.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "services/slam/lib/dynamic/fundamental_matrix.hpp"
#include "services/slam/lib/dynamic/homography.hpp"

namespace tsg {
namespace {

// 95 % of errors are below so many sigmas: in one direction, and in two.
constexpr double kQuantile1 = 1.960;
constexpr double kQuantile2 = 2.448;

// It matters only where it explains most pairs: with 60 % of them it is found with 0.9997.
constexpr int kHomographySamples = 60;

// Torr 1998: a pair has four coordinates; its cost stops growing where it is surely wrong.
constexpr double kDataDimension = 4.0;
constexpr double kOutlierCost = 2.0;  // times the dimensions that the relation takes away

/// What is weighed: the errors, and the freedom that a relation has to make them small.
struct Freedom {
  double dimension;   ///< of what is left to a pair: 3 on a line, 2 at a point
  double parameters;  ///< of the relation
};
constexpr Freedom kFundamental{.dimension = 3.0, .parameters = 7.0};
constexpr Freedom kHomography{.dimension = 2.0, .parameters = 8.0};

/// Of the errors, in squares of sigma.
double capped(double squared_error, const Freedom& freedom) {
  return std::min(squared_error, kOutlierCost * (kDataDimension - freedom.dimension));
}

double price(const Freedom& freedom, std::size_t pairs) {
  const auto count = static_cast<double>(pairs);
  return std::log(kDataDimension) * freedom.dimension * count +
         std::log(kDataDimension * count) * freedom.parameters;
}

double total_cost(const TwoViews& views, std::span<const PixelPair> pairs, double sigma_px) {
  const Freedom& freedom = views.F ? kFundamental : kHomography;
  double cost = price(freedom, pairs.size());
  for (const PixelPair& pair : pairs) {
    const double error = views.distance(pair) / sigma_px;
    cost += capped(error * error, freedom);
  }
  return cost;
}

}  // namespace

double TwoViews::distance(const PixelPair& pair) const {
  return F ? epipolar_distance(*F, pair.p1, pair.p2) : transfer_distance(H, pair.p1, pair.p2);
}

double TwoViews::limit(double max_distance_px) const {
  return F ? max_distance_px : max_distance_px * kQuantile2 / kQuantile1;
}

std::optional<TwoViews> estimate_two_views(std::span<const PixelPair> pairs,
                                           double max_distance_px) {
  if (pairs.size() < kMinFundamentalPairs) return std::nullopt;
  const double sigma_px = max_distance_px / kQuantile1;
  const auto homography = estimate_homography(
      pairs, {.max_distance_px = sigma_px * kQuantile2, .max_samples = kHomographySamples});
  std::optional<TwoViews> best;
  double cost = std::numeric_limits<double>::infinity();
  if (homography) {
    best = TwoViews{.F = std::nullopt, .H = homography->model};
    cost = total_cost(*best, pairs, sigma_px);
  }
  if (cost <= price(kFundamental, pairs.size())) return best;  // no F could do better
  const auto fundamental = estimate_fundamental(pairs, {.max_distance_px = max_distance_px});
  if (!fundamental) return best;
  const TwoViews views{.F = fundamental->model, .H = Eigen::Matrix3d::Identity()};
  return total_cost(views, pairs, sigma_px) < cost ? views : best;
}

}  // namespace tsg
