#include "common/render/renderer.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/calib3d.hpp>
#include <opencv2/core/utility.hpp>

#include "common/render/surface_light.hpp"

namespace tsg::render {
namespace {

/// Offsets of the further samples of an edge pixel: with its centre one in each third of the
/// columns and of the rows, whichever way the edge runs.
constexpr std::array<std::array<float, 2>, 2> kEdgeSamples{{{0.333F, -0.333F}, {-0.333F, 0.333F}}};
constexpr float kEdgeDepthStep = 0.02F;  // of the depth: a jump is an edge
constexpr float kEdgeTurn = 0.9F;        // cosine between normals: a sharper bend is an edge

std::vector<Eigen::Vector3f> pixel_directions(const CameraModel& camera) {
  std::vector<cv::Point2f> pixels;
  for (int y = 0; y < camera.height; ++y) {
    for (int x = 0; x < camera.width; ++x) {
      pixels.emplace_back(static_cast<float>(x), static_cast<float>(y));
    }
  }
  const cv::Matx33d intrinsics(camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1);
  std::vector<cv::Point2f> ideal;
  cv::undistortPoints(pixels, ideal, intrinsics,
                      std::vector<double>(camera.distortion.begin(), camera.distortion.end()));
  std::vector<Eigen::Vector3f> directions;
  directions.reserve(ideal.size());
  for (const cv::Point2f& point : ideal) directions.emplace_back(point.x, point.y, 1.0F);
  return directions;
}

/// Origin and axes of a camera in single precision.
struct Eye {
  explicit Eye(const SE3& T_world_camera)
      : R_world_camera(T_world_camera.rotation_matrix().cast<float>()),
        t_world_camera(T_world_camera.translation().cast<float>()) {}

  [[nodiscard]] Ray ray(const Eigen::Vector3f& direction) const {
    return {t_world_camera, R_world_camera * direction};
  }

  Eigen::Matrix3f R_world_camera;
  Eigen::Vector3f t_world_camera;
};

/// The pose between two, `share` 0..1 of the way.
SE3 between(const SE3& T_world_a, const SE3& T_world_b, double share) {
  return {T_world_a.rotation().slerp(share, T_world_b.rotation()),
          (1.0 - share) * T_world_a.translation() + share * T_world_b.translation()};
}

}  // namespace

/// The work on one picture.
class Renderer::Frame {
 public:
  Frame(Renderer& renderer, Stage& stage, const Shot& shot)
      : camera_(renderer.camera_),
        directions_(renderer.directions_),
        stage_(stage),
        to_open_(shot.T_world_open.inverse().to_isometry().cast<float>()),
        to_close_(shot.T_world_close.inverse().to_isometry().cast<float>()),
        pixel_angle_(static_cast<float>(1.0 / camera_.fx)),
        sightings_(renderer.sightings_),
        normals_(renderer.normals_) {
    for (int y = 0; y < camera_.height; ++y) {
      const double share = camera_.height > 1 ? static_cast<double>(y) / (camera_.height - 1) : 0.5;
      eyes_.emplace_back(between(shot.T_world_first_row, shot.T_world_last_row, share));
    }
    const cv::Size size(camera_.width, camera_.height);
    picture_ = {.radiance = cv::Mat(size, CV_32FC3, cv::Scalar::all(0)),
                .depth_m = cv::Mat(size, CV_32FC1, cv::Scalar(0)),
                .facing = cv::Mat(size, CV_32FC1, cv::Scalar(0)),
                .tags = cv::Mat(size, CV_16UC1, cv::Scalar(0)),
                .returns_depth = cv::Mat(size, CV_8UC1, cv::Scalar(0)),
                .motion_px = cv::Mat(size, CV_32FC2, cv::Scalar::all(0))};
  }

  Picture paint() {
    for_rows([this](int y) { look(y); });
    stage_.light_up(sightings_);
    for_rows([this](int y) { paint_row(y); });
    edges_.resize(static_cast<std::size_t>(camera_.height));
    for_rows([this](int y) { look_at_edges(y); });
    stage_.light_up(edge_sightings());
    for_rows([this](int y) { smooth_edges(y); });
    return std::move(picture_);
  }

 private:
  /// The edge pixels of one row, with kEdgeSamples rays each.
  struct EdgeRow {
    std::vector<int> columns;
    std::vector<Ray> rays;
    std::vector<Sighting> sightings;
  };

  template <typename Work>
  void for_rows(const Work& work) const {
    cv::parallel_for_(cv::Range(0, camera_.height), [&](const cv::Range& rows) {
      for (int y = rows.start; y < rows.end; ++y) work(y);
    });
  }

  [[nodiscard]] std::size_t index(int y, int x) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(camera_.width) +
           static_cast<std::size_t>(x);
  }
  [[nodiscard]] Ray ray(int y, int x) const {
    return eyes_[static_cast<std::size_t>(y)].ray(directions_[index(y, x)]);
  }

  void look(int y) {
    std::vector<Ray> rays;
    rays.reserve(static_cast<std::size_t>(camera_.width));
    for (int x = 0; x < camera_.width; ++x) rays.push_back(ray(y, x));
    stage_.look(rays, std::span(sightings_).subspan(index(y, 0), rays.size()));
  }

  void paint_row(int y) {
    for (int x = 0; x < camera_.width; ++x) {
      const Sighting& sighting = sightings_[index(y, x)];
      if (!sighting.hit.is_hit()) continue;
      const Ray sight = ray(y, x);
      const Eigen::Vector3f normal = normals_[index(y, x)] = normal_at(stage_, sighting, sight);
      const Eigen::Vector3f light = radiance_towards(stage_, sighting, sight, normal, pixel_angle_);
      picture_.radiance.at<cv::Vec3f>(y, x) = {light.x(), light.y(), light.z()};
      // Directions have z = 1 in camera axes, so that distances along them are depths.
      picture_.depth_m.at<float>(y, x) = sighting.hit.distance;
      picture_.facing.at<float>(y, x) = -normal.dot(sight.direction.normalized());
      const Layer& layer = stage_.layer(sighting.is_body);
      const Triangle& triangle = layer.mesh.triangles[sighting.hit.triangle];
      picture_.tags.at<std::uint16_t>(y, x) = layer.tags[sighting.hit.triangle];
      picture_.returns_depth.at<std::uint8_t>(y, x) =
          layer.mesh.materials[triangle.material].returns_depth ? 255 : 0;
      picture_.motion_px.at<cv::Vec2f>(y, x) = motion(sighting, sight);
    }
  }

  [[nodiscard]] cv::Vec2f motion(const Sighting& sighting, const Ray& sight) const {
    const Eigen::Vector3f position = sight.origin + sighting.hit.distance * sight.direction;
    const Eigen::Vector3f travel = stage_.travel(sighting);
    const Eigen::Vector3f open = to_open_ * Eigen::Vector3f(position - 0.5F * travel);
    const Eigen::Vector3f close = to_close_ * Eigen::Vector3f(position + 0.5F * travel);
    if (open.z() < 0.05F || close.z() < 0.05F) return {0.0F, 0.0F};
    return {static_cast<float>(camera_.fx) * (close.x() / close.z() - open.x() / open.z()),
            static_cast<float>(camera_.fy) * (close.y() / close.z() - open.y() / open.z())};
  }

  /// Whether a pixel and its neighbour show different things or sides of a thing.
  [[nodiscard]] bool differ(int y, int x, int other_y, int other_x) const {
    const Sighting& a = sightings_[index(y, x)];
    const Sighting& b = sightings_[index(other_y, other_x)];
    if (a.hit.is_hit() != b.hit.is_hit()) return true;
    if (!a.hit.is_hit() || (a.is_body == b.is_body && a.hit.triangle == b.hit.triangle)) {
      return false;
    }
    if (material(a) != material(b)) return true;
    const float nearer = std::min(a.hit.distance, b.hit.distance);
    if (std::abs(a.hit.distance - b.hit.distance) > kEdgeDepthStep * nearer) return true;
    return normals_[index(y, x)].dot(normals_[index(other_y, other_x)]) < kEdgeTurn;
  }

  [[nodiscard]] const Material* material(const Sighting& sighting) const {
    const Mesh& mesh = stage_.layer(sighting.is_body).mesh;
    return &mesh.materials[mesh.triangles[sighting.hit.triangle].material];
  }

  /// Finds the edges of a row and what is seen around their pixels' centres.
  void look_at_edges(int y) {
    EdgeRow& row = edges_[static_cast<std::size_t>(y)];
    for (int x = 0; x < camera_.width; ++x) {
      const bool is_edge = (x + 1 < camera_.width && differ(y, x, y, x + 1)) ||
                           (y + 1 < camera_.height && differ(y, x, y + 1, x)) ||
                           (x > 0 && differ(y, x, y, x - 1)) || (y > 0 && differ(y, x, y - 1, x));
      if (!is_edge) continue;
      row.columns.push_back(x);
      for (const auto& [right, down] : kEdgeSamples) {
        const Eigen::Vector3f offset(right / static_cast<float>(camera_.fx),
                                     down / static_cast<float>(camera_.fy), 0.0F);
        row.rays.push_back(
            eyes_[static_cast<std::size_t>(y)].ray(directions_[index(y, x)] + offset));
      }
    }
    row.sightings.resize(row.rays.size());
    stage_.look(row.rays, row.sightings);
  }

  [[nodiscard]] std::vector<Sighting> edge_sightings() const {
    std::vector<Sighting> all;
    for (const EdgeRow& row : edges_) {
      all.insert(all.end(), row.sightings.begin(), row.sightings.end());
    }
    return all;
  }

  /// Paints each edge pixel as the mean of its centre and the further samples.
  void smooth_edges(int y) {
    const EdgeRow& row = edges_[static_cast<std::size_t>(y)];
    for (std::size_t i = 0; i < row.columns.size(); ++i) {
      auto& pixel = picture_.radiance.at<cv::Vec3f>(y, row.columns[i]);
      Eigen::Vector3f sum(pixel[0], pixel[1], pixel[2]);
      for (std::size_t k = i * kEdgeSamples.size(); k < (i + 1) * kEdgeSamples.size(); ++k) {
        const Sighting& sighting = row.sightings[k];
        if (!sighting.hit.is_hit()) continue;
        const Eigen::Vector3f normal = normal_at(stage_, sighting, row.rays[k]);
        sum += radiance_towards(stage_, sighting, row.rays[k], normal, pixel_angle_);
      }
      sum /= static_cast<float>(kEdgeSamples.size() + 1);
      pixel = {sum.x(), sum.y(), sum.z()};
    }
  }

  const CameraModel& camera_;
  const std::vector<Eigen::Vector3f>& directions_;
  Stage& stage_;
  Eigen::Isometry3f to_open_;   ///< T_open_world
  Eigen::Isometry3f to_close_;  ///< T_close_world
  float pixel_angle_;
  std::vector<Eye> eyes_;       ///< of each row
  std::vector<EdgeRow> edges_;  ///< of each row
  std::vector<Sighting>& sightings_;
  std::vector<Eigen::Vector3f>& normals_;
  Picture picture_;
};

Renderer::Renderer(const CameraModel& camera)
    : camera_(camera),
      directions_(pixel_directions(camera)),
      sightings_(directions_.size()),
      normals_(directions_.size()) {}

Picture Renderer::render(Stage& stage, const Shot& shot) {
  return Frame(*this, stage, shot).paint();
}

}  // namespace tsg::render
