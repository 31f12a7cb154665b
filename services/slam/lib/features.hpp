#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "services/slam/lib/descriptor.hpp"
#include "services/slam/lib/feature_grid.hpp"
#include "services/slam/lib/surface.hpp"

namespace tsg {

/// What the instance masks say about the thing that a feature lies on.
enum class FeatureVerdict : std::uint8_t { kStatic, kPotentiallyDynamic, kDynamic };

/// A corner of one image.
struct Feature {
  Eigen::Vector2f pixel;       ///< undistorted
  float inverse_depth = 0.0F;  ///< 1/m; 0 where the sensor saw nothing usable
  float angle = 0.0F;          ///< radians, direction of the intensity centroid
  std::int16_t raw_x = 0;      ///< pixel as captured, for look-ups in images and masks
  std::int16_t raw_y = 0;
  std::uint8_t level = 0;  ///< of the pyramid, 0 = full resolution
  FeatureVerdict verdict = FeatureVerdict::kStatic;

  [[nodiscard]] bool has_depth() const { return inverse_depth > 0.0F; }
};

/// How many features of an image went which way.
struct FeatureCounts {
  int detected = 0;
  int dynamic = 0;              ///< dropped: on an instance of a dynamic class
  int potentially_dynamic = 0;  ///< kept: on an instance of a class that is sometimes moved
  int with_depth = 0;           ///< of those that were kept
};

/// The features of one image that may be used: those on dynamic instances are gone.
struct Features {
  std::uint64_t seq = 0;
  std::int64_t stamp_ns = 0;
  std::vector<Feature> items;
  std::vector<Descriptor> descriptors;  ///< one for each item
  FeatureGrid grid;                     ///< over the undistorted pixels
  Surface surface;                      ///< for where corners are few
  FeatureCounts counts;
  int mask_age_frames = -1;  ///< of the mask that was applied; -1 without one

  [[nodiscard]] std::size_t size() const { return items.size(); }
};

}  // namespace tsg
