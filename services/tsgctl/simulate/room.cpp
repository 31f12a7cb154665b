#include "services/tsgctl/simulate/room.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <opencv2/core.hpp>

namespace tsg {
namespace {

constexpr int kPersonId = 1;
constexpr double kNear = 1e-6;

struct Ray {
  Eigen::Vector3d origin;
  Eigen::Vector3d direction;  // of a length such that its camera z is 1: t is the depth
};

struct Hit {
  double t = std::numeric_limits<double>::infinity();
  const Box* box = nullptr;
};

/// Where the ray enters the box, or leaves it when it starts inside (slab method).
double intersect(const Ray& ray, const Box& box) {
  double enter = -std::numeric_limits<double>::infinity();
  double leave = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 3; ++axis) {
    const double inverse = 1.0 / ray.direction[axis];  // infinite along an axis: the test holds
    const double a = (box.min_m[axis] - ray.origin[axis]) * inverse;
    const double b = (box.max_m[axis] - ray.origin[axis]) * inverse;
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
  }
  if (enter > leave || leave < kNear) return std::numeric_limits<double>::infinity();
  return enter > kNear ? enter : leave;
}

Hit first_hit(const Ray& ray, const std::vector<Box>& boxes) {
  Hit hit;
  for (const Box& box : boxes) {
    if (const double t = intersect(ray, box); t < hit.t) hit = {t, &box};
  }
  return hit;
}

/// A number that looks random, 0..1, for a cell of a texture.
double noise(std::int64_t x, std::int64_t y, std::int64_t z, std::uint32_t seed) {
  auto mixed = static_cast<std::uint64_t>(x) * 0x9E3779B97F4A7C15ULL;
  mixed ^= static_cast<std::uint64_t>(y) * 0xC2B2AE3D27D4EB4FULL;
  mixed ^= static_cast<std::uint64_t>(z) * 0x165667B19E3779F9ULL + seed;
  mixed = (mixed ^ (mixed >> 30U)) * 0xBF58476D1CE4E5B9ULL;
  mixed = (mixed ^ (mixed >> 27U)) * 0x94D049BB133111EBULL;
  return static_cast<double>((mixed ^ (mixed >> 31U)) >> 40U) / static_cast<double>(1ULL << 24U);
}

double cell_noise(const Eigen::Vector3d& point, double cell_m, std::uint32_t seed) {
  // Half a cell off, so that faces do not lie on the border of two cells.
  const auto cell = [&](int axis) {
    return static_cast<std::int64_t>(std::floor(point[axis] / cell_m + 0.37));
  };
  return noise(cell(0), cell(1), cell(2), seed);
}

/// Patches of three sizes: corners to find at any distance. `point` moves with its box.
cv::Vec3d texture(const Eigen::Vector3d& point, std::uint32_t seed) {
  cv::Vec3d colour;
  for (unsigned channel = 0; channel < 3; ++channel) {
    const double tint = cell_noise(point, 0.5, seed + 17 * channel);
    colour[static_cast<int>(channel)] = 40.0 + 50.0 * tint + 70.0 * cell_noise(point, 0.14, seed) +
                                        80.0 * cell_noise(point, 0.045, seed + 1);
  }
  return colour;
}

Box moved(Box box, double time_s) {
  box.min_m += box.velocity_mps * time_s;
  box.max_m += box.velocity_mps * time_s;
  return box;
}

}  // namespace

Room::Room()
    : boxes_{{{-2.6, -1.5, -1.5}, {2.6, 1.2, 3.6}, 11, 0},
             {{-1.9, 0.3, 1.9}, {-0.9, 1.2, 2.7}, 23, 2},
             {{0.9, 0.5, 1.7}, {1.5, 1.2, 2.3}, 37, 3},
             {{1.6, -0.2, 2.7}, {2.2, 1.2, 3.3}, 41, 4},
             {{-0.5, 0.8, 2.8}, {0.3, 1.2, 3.3}, 53, 5},
             {{-1.6, -0.6, 1.5}, {-1.2, 1.2, 1.8}, 67, kPersonId, {0.45, 0.0, 0.0}}},
      classes_{{kPersonId, "person"},
               {2, "dining table"},
               {3, "chair"},
               {4, "refrigerator"},
               {5, "suitcase"}} {}

bool Room::moves(int instance_id) { return instance_id == kPersonId; }

std::vector<Box> Room::boxes_at(double time_s) const {
  std::vector<Box> boxes;
  for (const Box& box : boxes_) boxes.push_back(moved(box, time_s));
  return boxes;
}

SE3 Room::T_world_camera(double time_s) {
  const double phase = 2.0 * std::numbers::pi * time_s / 6.0;
  const Eigen::Vector3d position(0.25 * std::sin(phase), 0.08 * std::sin(2.0 * phase),
                                 0.2 * (1.0 - std::cos(phase)) / 2.0);
  const Eigen::AngleAxisd yaw(0.12 * std::sin(phase), Eigen::Vector3d::UnitY());
  const Eigen::AngleAxisd pitch(0.05 * std::sin(2.0 * phase), Eigen::Vector3d::UnitX());
  return {Eigen::Quaterniond(yaw * pitch), position};
}

RoomView Room::render(const CameraModel& camera, const SE3& T_world_camera, double time_s) const {
  const std::vector<Box> boxes = boxes_at(time_s);
  RoomView view{cv::Mat(camera.height, camera.width, CV_8UC3),
                cv::Mat(camera.height, camera.width, CV_16UC1),
                cv::Mat(camera.height, camera.width, CV_8UC1)};
  const Eigen::Matrix3d R_world_camera = T_world_camera.rotation_matrix();
  const auto shoot = [&](double u, double v) {
    const Eigen::Vector3d in_camera((u - camera.cx) / camera.fx, (v - camera.cy) / camera.fy, 1.0);
    return Ray{T_world_camera.translation(), R_world_camera * in_camera};
  };
  // Four rays a pixel for the colour, as a sensor averages; depth and id are of its middle.
  constexpr std::array<std::array<double, 2>, 4> kOffsets{
      {{-0.25, -0.25}, {0.25, -0.25}, {-0.25, 0.25}, {0.25, 0.25}}};
  cv::parallel_for_(cv::Range(0, camera.height * camera.width), [&](const cv::Range& pixels) {
    for (int i = pixels.start; i < pixels.end; ++i) {
      const int u = i % camera.width;
      const int v = i / camera.width;
      cv::Vec3d sum;
      for (const auto& offset : kOffsets) {
        const Ray ray = shoot(u + offset[0], v + offset[1]);
        const Hit hit = first_hit(ray, boxes);
        const Eigen::Vector3d point = ray.origin + hit.t * ray.direction;
        sum += texture(point - hit.box->velocity_mps * time_s, hit.box->texture_seed);
      }
      const Hit middle = first_hit(shoot(u, v), boxes);
      view.colour.at<cv::Vec3b>(v, u) = cv::Vec3b(sum / 4.0);
      view.depth.at<std::uint16_t>(v, u) =
          cv::saturate_cast<std::uint16_t>(middle.t * kSimulatedDepthUnits);
      view.ids.at<std::uint8_t>(v, u) = cv::saturate_cast<std::uint8_t>(middle.box->instance_id);
    }
  });
  return view;
}

}  // namespace tsg
