#pragma once

#include <optional>
#include <string_view>

#include "common/dataset/camera_file.hpp"

namespace tsg {

/// The camera of a sequence of the TUM RGB-D benchmark, whose archives hold no calibration, by the
/// sequence's name: "rgbd_dataset_freiburg1_desk". Intrinsics of the colour camera as the benchmark
/// publishes them (fr1 and fr2 are distorted, fr3 is rectified); 5000 units of depth are a metre.
/// Nothing for names that are not of the benchmark.
[[nodiscard]] std::optional<RecordedCamera> tum_benchmark_camera(std::string_view sequence_name);

}  // namespace tsg
