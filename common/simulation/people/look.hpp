#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <opencv2/core/matx.hpp>

namespace tsg::simulation {

enum class Pattern { kPlain, kStripes, kChecks, kDiamonds, kDots, kPrint, kBlocks, kKnit, kDenim };
enum class Top { kTShirt, kShirt, kJumper, kJacket };
enum class Bottom { kTrousers, kSkirt };
enum class Hair { kShort, kCropped, kBob, kLong, kBun };

/// Colours of a cloth, sRGB-coded BGR.
struct Cloth {
  Pattern pattern = Pattern::kPlain;
  cv::Vec3b ground;
  cv::Vec3b accent;
  cv::Vec3b second;
  std::uint64_t seed = 0;
};

/// What a person looks like: all that chance decides.
struct Look {
  cv::Vec3b skin;
  cv::Vec3b hair_colour;
  cv::Vec3b eyes;
  cv::Vec3b shoes;
  Hair hair = Hair::kShort;
  Top top = Top::kShirt;
  Bottom bottom = Bottom::kTrousers;
  Cloth top_cloth;
  Cloth bottom_cloth;
  bool has_glasses = false;
  bool has_beard = false;
  bool is_feminine = false;
  double girth = 1.0;           ///< of trunk and limbs, relative to the mean
  double shoulder_width = 1.0;  ///< see make_skeleton()
  double hip_width = 1.0;
  std::uint64_t seed = 0;
};

[[nodiscard]] Look make_look(std::uint64_t seed);

}  // namespace tsg::simulation
