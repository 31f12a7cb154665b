#include "services/slam/lib/dynamic/pixel_pair.hpp"

#include <numbers>

namespace tsg {
namespace {

Eigen::Matrix3d similarity(const Eigen::Vector2d& centroid, double mean_distance) {
  const double scale = std::numbers::sqrt2 / mean_distance;
  Eigen::Matrix3d K = Eigen::Matrix3d::Identity();
  K.topLeftCorner<2, 2>() *= scale;
  K.topRightCorner<2, 1>() = -scale * centroid;
  return K;
}

}  // namespace

Normalisation::Normalisation(std::span<const PixelPair> pairs) {
  const auto count = static_cast<double>(pairs.size());
  Eigen::Vector2d centroid1 = Eigen::Vector2d::Zero();
  Eigen::Vector2d centroid2 = Eigen::Vector2d::Zero();
  for (const PixelPair& pair : pairs) {
    centroid1 += pair.p1 / count;
    centroid2 += pair.p2 / count;
  }
  double distance1 = 0.0;
  double distance2 = 0.0;
  for (const PixelPair& pair : pairs) {
    distance1 += (pair.p1 - centroid1).norm() / count;
    distance2 += (pair.p2 - centroid2).norm() / count;
  }
  N1 = similarity(centroid1, distance1);
  N2 = similarity(centroid2, distance2);
}

}  // namespace tsg
