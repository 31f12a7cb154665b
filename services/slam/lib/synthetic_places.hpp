#pragma once

// For tests and benchmarks: features of views that look like real ones, by the hundred.

#include <memory>
#include <random>
#include <vector>

#include "services/slam/lib/feature_extractor.hpp"
#include "services/slam/lib/synthetic_scene.hpp"

namespace tsg::synthetic {

/// Features of a place of its own: the room with other textures.
inline Features place(unsigned seed, const SE3& T_world_camera = SE3()) {
  Scene scene(
      {{.z = 3.0, .corner = {-4.0, -3.0}, .extent = {8.0, 6.0}, .texture_seed = 10 * seed},
       {.z = 2.0, .corner = {-0.9, -0.4}, .extent = {0.8, 1.0}, .texture_seed = 10 * seed + 1}});
  FeatureExtractor extractor(FeatureConfig{}, camera());
  return extractor.extract(scene.render(0, T_world_camera), {});
}

/// The same features with each bit of the descriptors turned over with a probability: 0.12
/// is about what another view does.
inline std::shared_ptr<const Features> disguised(const Features& features,
                                                 double probability,
                                                 std::mt19937& generator) {
  auto copy = std::make_shared<Features>(features);
  std::bernoulli_distribution turn(probability);
  for (Descriptor& descriptor : copy->descriptors) {
    for (std::uint64_t& word : descriptor) {
      for (unsigned bit = 0; bit < 64; ++bit) {
        word ^= static_cast<std::uint64_t>(turn(generator)) << bit;
      }
    }
  }
  return copy;
}

/// A place made of features of several others, each somewhat changed.
inline std::shared_ptr<const Features> mixed(const std::vector<Features>& others,
                                             std::mt19937& generator) {
  Features mixture = others.front();
  for (Descriptor& descriptor : mixture.descriptors) {
    const Features& source = others[generator() % others.size()];
    descriptor = source.descriptors[generator() % source.size()];
  }
  return disguised(mixture, 0.12, generator);
}

}  // namespace tsg::synthetic
