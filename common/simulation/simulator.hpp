#pragma once

#include <cstdint>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

#include "common/core/error.hpp"
#include "common/geometry/camera_model.hpp"
#include "common/geometry/se3.hpp"
#include "common/simulation/scene.hpp"

namespace tsg::simulation {

class World;

/// Raw depth is in units of 1/5000 m, as in TUM RGB-D sequences.
inline constexpr double kDepthUnitsPerMetre = 5000.0;

/// An object or person of the scene.
struct SimulatedInstance {
  int id = 0;              ///< 1.. ; pixels of SimulatedFrame::ids
  std::string class_name;  ///< COCO class where COCO has one
  std::string name;
  bool is_dynamic = false;  ///< moves at some time of the scene
};

/// One frame with its truth. The mats are the caller's.
struct SimulatedFrame {
  std::int64_t since_start_ns = 0;
  SE3 T_world_camera;       ///< of the middle of the exposure (and the middle row)
  cv::Mat colour;           ///< CV_8UC3, BGR
  cv::Mat depth;            ///< CV_16UC1, kDepthUnitsPerMetre; 0 where the sensor sees nothing
  cv::Mat ids;              ///< CV_16UC1: instance of each pixel; 0 = the building
  std::vector<int> moving;  ///< ids of what moves at this moment, ascending
};

/// Renders a scene frame by frame, in any order: the same scene and frame give the same bytes.
/// Not thread-safe; uses all cores of the machine while it renders.
class Simulator {
 public:
  /// Builds geometry and light; takes seconds. kBadData names what in the scene does not fit.
  [[nodiscard]] static Expected<Simulator> build(const SceneDescription& scene);

  Simulator(Simulator&&) noexcept;
  Simulator& operator=(Simulator&&) noexcept;
  Simulator(const Simulator&) = delete;
  Simulator& operator=(const Simulator&) = delete;
  ~Simulator();

  [[nodiscard]] const SceneDescription& scene() const;
  [[nodiscard]] int frame_count() const;  ///< duration times rate
  [[nodiscard]] std::int64_t since_start_ns(int frame) const;
  [[nodiscard]] SE3 T_world_camera(double time_s) const;
  [[nodiscard]] const std::vector<SimulatedInstance>& instances() const;

  /// The geometry behind the frames: for truth that no frame shows. Valid as long as this object.
  [[nodiscard]] const World& world() const;

  /// `frame` 0.. ; beyond frame_count() the scene goes on as its actors do.
  [[nodiscard]] SimulatedFrame render(int frame);

 private:
  struct Impl;
  explicit Simulator(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace tsg::simulation
