#pragma once

// For tests and benchmarks: two images of points, some of which move in between.

#include <Eigen/Core>
#include <cstdint>
#include <random>
#include <vector>

#include "services/slam/lib/dynamic/pixel_pair.hpp"
#include "services/slam/lib/features.hpp"
#include "services/slam/lib/synthetic_scene.hpp"

namespace tsg::synthetic {

/// Points of one body: `first` in the reference frame, `first + motion` in the current one.
struct Body {
  std::vector<Eigen::Vector3d> points;  ///< world, metres
  Eigen::Vector3d motion = Eigen::Vector3d::Zero();
  FeatureVerdict prior = FeatureVerdict::kStatic;
};

/// A cube of points with 0.6 m edges.
inline Body box_at(const Eigen::Vector3d& centre, std::size_t count, unsigned seed) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> offset(-0.3, 0.3);
  Body body;
  while (body.points.size() < count) {
    body.points.emplace_back(
        centre + Eigen::Vector3d(offset(generator), offset(generator), offset(generator)));
  }
  return body;
}

/// A room of points that stand still.
inline Body room(std::size_t count, unsigned seed) {
  std::mt19937 generator(seed);
  return {.points = random_points(generator, count)};
}

/// A body in both images; the reference camera stands at the world's origin.
inline std::vector<PixelPair> pairs_of(const Body& body, const SE3& T_world_current) {
  const SE3 T_current_world = T_world_current.inverse();
  std::vector<PixelPair> pairs;
  for (const Eigen::Vector3d& point : body.points) {
    pairs.push_back(
        {camera().project(point), camera().project(T_current_world * (point + body.motion))});
  }
  return pairs;
}

inline void add_noise(std::vector<PixelPair>& pairs, double sigma_px, unsigned seed) {
  std::mt19937 generator(seed);
  std::normal_distribution<double> noise(0.0, sigma_px);
  for (PixelPair& pair : pairs) {
    pair.p1 += Eigen::Vector2d(noise(generator), noise(generator));
    pair.p2 += Eigen::Vector2d(noise(generator), noise(generator));
  }
}

/// Both frames as features that look alike; feature i of one is feature i of the other. Bodies
/// follow one another.
struct TwoFrames {
  Features reference;
  Features current;
};

inline Feature feature_at(const Eigen::Vector2d& pixel, FeatureVerdict prior) {
  Feature feature;
  feature.pixel = pixel.cast<float>();
  feature.verdict = prior;
  return feature;
}

inline TwoFrames observe(const std::vector<Body>& bodies,
                         const SE3& T_world_current,
                         double sigma_px) {
  constexpr unsigned kSeed = 7;
  std::mt19937_64 looks(kSeed);
  TwoFrames frames;
  for (const Body& body : bodies) {
    std::vector<PixelPair> pairs = pairs_of(body, T_world_current);
    add_noise(pairs, sigma_px, kSeed + static_cast<unsigned>(frames.current.size()));
    for (const PixelPair& pair : pairs) {
      frames.reference.items.push_back(feature_at(pair.p1, body.prior));
      frames.current.items.push_back(feature_at(pair.p2, body.prior));
      frames.reference.descriptors.push_back({looks(), looks(), looks(), looks()});
    }
  }
  frames.current.descriptors = frames.reference.descriptors;
  frames.reference.grid = FeatureGrid(frames.reference.items, camera().width, camera().height);
  frames.current.grid = FeatureGrid(frames.current.items, camera().width, camera().height);
  return frames;
}

}  // namespace tsg::synthetic
