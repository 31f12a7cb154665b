#pragma once

#include <filesystem>

#include "common/core/error.hpp"
#include "common/geometry/camera_model.hpp"

namespace tsg {

/// The camera that a sequence was recorded with.
struct RecordedCamera {
  CameraModel model;
  double depth_units_per_metre = 5000.0;
  double fps = 30.0;
};

/// Reads a camera.yaml, plain or with OpenCV's header: fx fy cx cy width height depth_scale, and
/// optionally k1 k2 p1 p2 k3 (0), fps (30) and depth_registered (must not be 0). kMissingInput
/// where it is absent; kBadData, naming file, line and key, for unknown, repeated or missing keys
/// and values that do not work; kInvalidNumber for NaN and infinity.
[[nodiscard]] Expected<RecordedCamera> read_camera_file(const std::filesystem::path& path);

}  // namespace tsg
