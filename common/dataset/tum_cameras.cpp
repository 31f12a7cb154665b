#include "common/dataset/tum_cameras.hpp"

namespace tsg {
namespace {

constexpr std::string_view kPrefix = "rgbd_dataset_freiburg";

CameraModel vga(double fx, double fy, double cx, double cy) {
  return {.width = 640, .height = 480, .fx = fx, .fy = fy, .cx = cx, .cy = cy};
}

CameraModel freiburg1() {
  CameraModel model = vga(517.3, 516.5, 318.6, 255.3);
  model.distortion = {0.2624, -0.9531, -0.0054, 0.0026, 1.1633};
  return model;
}

CameraModel freiburg2() {
  CameraModel model = vga(520.9, 521.0, 325.1, 249.7);
  model.distortion = {0.2312, -0.7849, -0.0033, -0.0001, 0.9172};
  return model;
}

CameraModel freiburg3() { return vga(535.4, 539.2, 320.1, 247.6); }

}  // namespace

std::optional<RecordedCamera> tum_benchmark_camera(std::string_view sequence_name) {
  if (!sequence_name.starts_with(kPrefix) || sequence_name.size() == kPrefix.size()) {
    return std::nullopt;
  }
  switch (sequence_name[kPrefix.size()]) {
    case '1':
      return RecordedCamera{.model = freiburg1()};
    case '2':
      return RecordedCamera{.model = freiburg2()};
    case '3':
      return RecordedCamera{.model = freiburg3()};
    default:
      return std::nullopt;
  }
}

}  // namespace tsg
