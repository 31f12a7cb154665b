#include "common/simulation/simulator.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/core.hpp>
#include <sstream>
#include <utility>

#include "common/render/preview.hpp"
#include "common/render/renderer.hpp"
#include "common/render/stage.hpp"
#include "common/simulation/camera/camera_path.hpp"
#include "common/simulation/sensor/colour_sensor.hpp"
#include "common/simulation/sensor/depth_sensor.hpp"
#include "common/simulation/sensor/noise_table.hpp"
#include "common/simulation/world/world.hpp"

namespace tsg::simulation {
namespace {

constexpr double kMeanLight = 0.2;  // of white: what auto-exposure aims at
constexpr int kExposureLooks = 6;   // moments of the scene that the exposure is chosen by
constexpr int kExposureScale = 8;   // pixels left out while looking

constexpr int kViewScale = 2;
constexpr double kBesideS = 1e-3;

std::string seconds_text(double seconds) {
  std::ostringstream text;
  text << seconds;
  return text.str();
}

/// The same view with fewer pixels.
CameraModel scaled_down(CameraModel camera, int factor) {
  camera.width = std::max(camera.width / factor, 1);
  camera.height = std::max(camera.height / factor, 1);
  for (double* value : {&camera.fx, &camera.fy, &camera.cx, &camera.cy}) *value /= factor;
  return camera;
}

double mean_light(const cv::Mat& radiance) {
  const cv::Scalar mean = cv::mean(cv::min(radiance, 1.0));
  return (mean[0] + mean[1] + mean[2]) / 3.0;
}

}  // namespace

struct Simulator::Impl {
  SceneDescription scene;
  CameraPath path;
  World world;
  render::Stage stage;
  render::Renderer renderer;
  std::unique_ptr<const NoiseTable> noise;
  DepthSensor depth_sensor;
  ColourSensor colour_sensor;

  Impl(const SceneDescription& description, CameraPath camera_path, World built)
      : scene(description),
        path(std::move(camera_path)),
        world(std::move(built)),
        stage(world.fixed(), world.bodies(), world.lamps()),
        renderer(scene.sensor.camera),
        noise(std::make_unique<NoiseTable>(scene.seed)),
        depth_sensor(scene.sensor, *noise),
        colour_sensor(scene.sensor, *noise, choose_exposure(), scene.seed) {}

  /// Bodies at `time_s`, blurred by what they travel while the shutter is open.
  void pose_bodies(double time_s) {
    const double half_exposure_s = 0.5 * scene.sensor.exposure_s;
    std::vector<Eigen::Vector3f> points;
    std::vector<Eigen::Vector3f> normals;
    std::vector<Eigen::Vector3f> travel;
    std::vector<Eigen::Vector3f> unused;
    for (std::size_t body = 0; body < world.bodies().size(); ++body) {
      world.pose_body(body, time_s - half_exposure_s, points, unused);
      world.pose_body(body, time_s + half_exposure_s, travel, unused);
      for (std::size_t i = 0; i < travel.size(); ++i) travel[i] -= points[i];
      world.pose_body(body, time_s, points, normals);
      stage.pose_body(body, points, normals, travel);
    }
    stage.update();
  }

  [[nodiscard]] render::Shot shot_at(double time_s) const {
    const SensorDescription& sensor = scene.sensor;
    const double half_exposure_s = 0.5 * sensor.exposure_s;
    const double half_readout_s = sensor.rolling_shutter ? 0.5 * sensor.readout_s : 0.0;
    return {.T_world_camera = path.T_world_camera(time_s),
            .T_world_open = path.T_world_camera(time_s - half_exposure_s),
            .T_world_close = path.T_world_camera(time_s + half_exposure_s),
            .T_world_first_row = path.T_world_camera(time_s - half_readout_s),
            .T_world_last_row = path.T_world_camera(time_s + half_readout_s)};
  }

  /// An exposure that suits the whole scene, as a camera with its automatics would settle on.
  [[nodiscard]] double choose_exposure() {
    render::Renderer small(scaled_down(scene.sensor.camera, kExposureScale));
    std::vector<double> means;
    for (int i = 0; i < kExposureLooks; ++i) {
      const double time_s = scene.duration_s * i / kExposureLooks;
      pose_bodies(time_s);
      means.push_back(mean_light(small.render(stage, shot_at(time_s)).radiance));
    }
    std::ranges::nth_element(means, means.begin() + kExposureLooks / 2);
    const double light = means[kExposureLooks / 2];
    return light > 0.0 ? kMeanLight / light : 1.0;  // in a dark room nothing helps
  }

  /// A thing that jumps before the camera's eyes would be no test of anything.
  [[nodiscard]] Expected<void> check_relocations() {
    for (const RelocationDescription& relocation : scene.relocations) {
      if (!is_in_view(relocation)) continue;
      return make_error(ExitCode::kBadData,
                        "object '" + relocation.object + "' is relocated at " +
                            seconds_text(relocation.at_s) +
                            " s, while the camera sees it; choose a time when it is out of view");
    }
    return {};
  }

  /// Whether any pixel shows the object just before or just after it is moved.
  [[nodiscard]] bool is_in_view(const RelocationDescription& relocation) {
    render::Renderer small(scaled_down(scene.sensor.camera, kViewScale));
    const auto instance =
        std::ranges::find(world.instances(), relocation.object, &SimulatedInstance::name);
    return std::ranges::any_of(std::array{-kBesideS, kBesideS}, [&](double beside_s) {
      const double time_s = relocation.at_s + beside_s;
      pose_bodies(time_s);
      const render::Shot shot = render::Shot::still(path.T_world_camera(time_s));
      return cv::countNonZero(small.render(stage, shot).tags == instance->id) > 0;
    });
  }

  [[nodiscard]] bool is_covered(double time_s) const {
    return std::ranges::any_of(scene.camera.covered_s, [time_s](const auto& span) {
      return time_s >= span.first && time_s < span.second;
    });
  }
};

Simulator::Simulator(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Simulator::Simulator(Simulator&&) noexcept = default;
Simulator& Simulator::operator=(Simulator&&) noexcept = default;
Simulator::~Simulator() = default;

Expected<Simulator> Simulator::build(const SceneDescription& scene) {
  auto path = CameraPath::make(scene.camera, scene.seed);
  if (!path) return tl::unexpected(path.error());
  auto world = World::build(scene);
  if (!world) return tl::unexpected(world.error());
  auto impl = std::make_unique<Impl>(scene, std::move(*path), std::move(*world));
  if (const auto ok = impl->check_relocations(); !ok) return tl::unexpected(ok.error());
  return Simulator(std::move(impl));
}

const SceneDescription& Simulator::scene() const { return impl_->scene; }

int Simulator::frame_count() const {
  return static_cast<int>(std::lround(impl_->scene.duration_s * impl_->scene.sensor.rate_hz));
}

std::int64_t Simulator::since_start_ns(int frame) const {
  // Whole microseconds, as the files have them.
  return 1000 * std::llround(1e6 * frame / impl_->scene.sensor.rate_hz);
}

SE3 Simulator::T_world_camera(double time_s) const { return impl_->path.T_world_camera(time_s); }

const std::vector<SimulatedInstance>& Simulator::instances() const {
  return impl_->world.instances();
}

const World& Simulator::world() const { return impl_->world; }

SimulatedFrame Simulator::render(int frame) {
  const std::int64_t since_start_ns = this->since_start_ns(frame);
  const double time_s = static_cast<double>(since_start_ns) * 1e-9;
  const auto number = static_cast<std::uint64_t>(frame);
  impl_->pose_bodies(time_s);
  const render::Shot shot = impl_->shot_at(time_s);
  const render::Picture picture = impl_->renderer.render(impl_->stage, shot);
  cv::Mat depth = impl_->depth_sensor.measure(picture, number);
  cv::Mat ids = picture.tags;
  const bool covered = impl_->is_covered(time_s);
  if (covered) {
    depth.setTo(0);
    ids.setTo(0);  // nobody can see anything
  }
  return {.since_start_ns = since_start_ns,
          .T_world_camera = shot.T_world_camera,
          .colour = impl_->colour_sensor.expose(picture, number, time_s, covered),
          .depth = depth,
          .ids = ids,
          .moving = impl_->world.moving(time_s)};
}

}  // namespace tsg::simulation
