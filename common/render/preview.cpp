#include "common/render/preview.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <opencv2/core.hpp>
#include <opencv2/core/utility.hpp>

#include "common/render/renderer.hpp"

namespace tsg::render {
namespace {

/// sRGB codes of light 0..1, finely enough for 8 bits in the dark too.
constexpr int kCodes = 4096;

std::array<std::uint8_t, kCodes + 1> make_code_table() {
  std::array<std::uint8_t, kCodes + 1> table{};
  for (std::size_t i = 0; i < table.size(); ++i) {
    const double light = static_cast<double>(i) / kCodes;
    const double code =
        light <= 0.0031308 ? 12.92 * light : 1.055 * std::pow(light, 1.0 / 2.4) - 0.055;
    table.at(i) = static_cast<std::uint8_t>(std::lround(255.0 * code));
  }
  return table;
}

/// Straight up to 0.8, then ever flatter towards 1: lamps and windows keep their shape.
float compressed(float light) {
  constexpr float kKnee = 0.8F;
  if (light <= kKnee) return std::max(light, 0.0F);
  return 1.0F - (1.0F - kKnee) * std::exp(-(light - kKnee) / (1.0F - kKnee));
}

void encode_row(const cv::Mat& radiance, float exposure, int y, cv::Mat& codes) {
  static const auto kTable = make_code_table();
  const auto* const light = radiance.ptr<float>(y);
  auto* const code = codes.ptr<std::uint8_t>(y);
  for (int i = 0; i < 3 * radiance.cols; ++i) {
    const float level = compressed(exposure * light[i]);
    code[i] = kTable.at(static_cast<std::size_t>(std::min(level, 1.0F) * kCodes));
  }
}

/// Four big lamps above and around the thing, so that all sides get some light.
std::vector<Lamp> studio_lamps(const Mesh& mesh) {
  Eigen::Vector3f low = Eigen::Vector3f::Constant(1e9F);
  Eigen::Vector3f high = -low;
  for (const Eigen::Vector3f& point : mesh.points) {
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }
  const Eigen::Vector3f centre = 0.5F * (low + high);
  const float reach = std::max(0.5F * (high - low).norm(), 0.1F);
  std::vector<Lamp> lamps;
  for (const Eigen::Vector3f& side :
       {Eigen::Vector3f(0.3F, 0.2F, 2.0F), Eigen::Vector3f(2.0F, 1.0F, 1.0F),
        Eigen::Vector3f(-1.5F, 2.0F, 0.8F), Eigen::Vector3f(-0.5F, -2.2F, 1.0F)}) {
    const Eigen::Vector3f normal = -side.normalized();
    const Eigen::Vector3f a = normal.unitOrthogonal();
    lamps.push_back({centre + 2.0F * reach * side, reach * a, reach * normal.cross(a), normal,
                     Eigen::Vector3f::Constant(side.z() > 1.5F ? 8.0F : 5.0F)});
  }
  return lamps;
}

}  // namespace

cv::Mat to_srgb(const cv::Mat& radiance, float exposure) {
  cv::Mat codes(radiance.size(), CV_8UC3);
  cv::parallel_for_(cv::Range(0, radiance.rows), [&](const cv::Range& rows) {
    for (int y = rows.start; y < rows.end; ++y) encode_row(radiance, exposure, y, codes);
  });
  return codes;
}

SE3 look_at(const Eigen::Vector3d& eye_m, const Eigen::Vector3d& target_m) {
  const Eigen::Vector3d forward = (target_m - eye_m).normalized();
  Eigen::Vector3d right = forward.cross(Eigen::Vector3d::UnitZ());
  // Straight up or down there is no level: any right will do.
  right = right.norm() > 1e-6 ? right.normalized() : Eigen::Vector3d(Eigen::Vector3d::UnitX());
  Eigen::Matrix3d R_world_camera;
  R_world_camera << right, forward.cross(right), forward;
  return {R_world_camera, eye_m};
}

cv::Mat render_view(Stage& stage, const Viewpoint& viewpoint) {
  const double half_angle = viewpoint.field_of_view_deg * std::numbers::pi / 360.0;
  const double focal = 0.5 * viewpoint.size.width / std::tan(half_angle);
  const CameraModel camera{.width = viewpoint.size.width,
                           .height = viewpoint.size.height,
                           .fx = focal,
                           .fy = focal,
                           .cx = 0.5 * (viewpoint.size.width - 1),
                           .cy = 0.5 * (viewpoint.size.height - 1)};
  const Shot shot = Shot::still(look_at(viewpoint.eye_m, viewpoint.target_m));
  return to_srgb(Renderer(camera).render(stage, shot).radiance);
}

cv::Mat render_preview(const Mesh& mesh, const Viewpoint& viewpoint) {
  Stage stage({{mesh, 1}}, {}, studio_lamps(mesh));
  return render_view(stage, viewpoint);
}

}  // namespace tsg::render
