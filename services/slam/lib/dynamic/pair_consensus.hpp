#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "services/slam/lib/dynamic/pixel_pair.hpp"

namespace tsg {

/// A relation between two images that is a 3x3 matrix, and how it is found from pairs.
struct PairModel {
  std::size_t sample = 0;  ///< pairs that determine it
  /// Least squares over `sample` pairs or more; nothing where they do not determine it.
  std::optional<Eigen::Matrix3d> (*fit)(std::span<const PixelPair> pairs) = nullptr;
  /// How far a pair is from the relation, pixels.
  double (*distance)(const Eigen::Matrix3d& model, const PixelPair& pair) = nullptr;
};

struct ConsensusLimits {
  double max_distance_px = 1.0;  ///< of pairs that agree with the relation
  int max_samples = 500;         // 8 pairs of which 40 % are wrong: found with probability 0.9998
  double confidence = 0.99;      // that one sample was free of wrong pairs; more samples otherwise
};

struct Consensus {
  Eigen::Matrix3d model;
  std::vector<bool> agrees;  ///< one for each pair
  int count = 0;             ///< of those that agree
};

/// The relation that most of `pairs` agree with: random samples, the distances beyond the limit
/// cut off (MSAC; Torr and Zisserman 2000), each best sample refitted to all that agree with it
/// (Chum et al. 2003). The generator starts anew in each call: the same pairs give the same answer.
/// Nothing where no sample determines the relation.
[[nodiscard]] std::optional<Consensus> find_consensus(const PairModel& model,
                                                      std::span<const PixelPair> pairs,
                                                      const ConsensusLimits& limits);

}  // namespace tsg
