#pragma once

#include <Eigen/Core>
#include <span>

namespace tsg {

/// One thing seen in two images: undistorted pixels.
struct PixelPair {
  Eigen::Vector2d p1;  ///< in the reference image
  Eigen::Vector2d p2;  ///< in the current image
};

/// The similarities that move each image's pixels to centroid 0 and mean distance sqrt(2), without
/// which linear estimates from pixels are badly conditioned (Hartley 1997). Not finite where all
/// pixels of an image coincide.
struct Normalisation {
  explicit Normalisation(std::span<const PixelPair> pairs);

  Eigen::Matrix3d N1;  ///< normalised from pixels of the reference image, homogeneous
  Eigen::Matrix3d N2;  ///< the same of the current image
};

}  // namespace tsg
