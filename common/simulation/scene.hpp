#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/geometry/camera_model.hpp"

/// What a scene file says (config/scenes/*.yaml, docs/simulation.md), as plain data. World axes: z
/// up, floor at z = 0. Angles: yaw counter-clockwise from +x, seen from above. Times count from the
/// first frame.
namespace tsg::simulation {

/// Where a thing stands: its own x axis is its front.
struct FloorPose {
  Eigen::Vector2d position_m = Eigen::Vector2d::Zero();
  double yaw_rad = 0.0;
};

/// A rectangular room; rooms that touch share a wall, which doors open.
struct RoomDescription {
  std::string name{};
  Eigen::Vector2d min_m = Eigen::Vector2d::Zero();  ///< corner of the floor
  Eigen::Vector2d max_m = Eigen::Vector2d::Zero();  ///< opposite corner
  double height_m = 2.7;
  std::string floor = "carpet";  ///< a surface (furniture/surfaces.hpp)
  std::string walls = "plaster";
  std::optional<Eigen::Vector3d> wall_colour_rgb{};  ///< 0..1; the surface's own where absent
  int lamps = 4;                                     ///< ceiling panels, evenly spread
  double brightness = 1.0;                           ///< of the lamps
};

/// A door or window: the hole is cut into every wall within 0.3 m of `position_m`.
struct OpeningDescription {
  Eigen::Vector2d position_m = Eigen::Vector2d::Zero();
  double width_m = 0.9;
  double open_deg = 90.0;  ///< doors: how far the leaf stands open
  bool has_leaf = true;    ///< doors: else a mere passage, or its leaf is an object that moves
};

/// A piece of furniture or a thing on it.
struct ObjectDescription {
  std::string type{};      ///< of the catalogue (furniture/catalogue.hpp), e.g. "office_chair"
  std::string name{};      ///< unique
  std::string on{};        ///< name of what it stands on; empty: the floor
  FloorPose pose{};        ///< in the world, or in the axes of what it stands on
  double height_m = 0.0;   ///< bottom above the floor, for things on walls; without `on` only
  std::uint64_t look = 0;  ///< which of its colours and patterns; 0: chosen by name and seed
  std::array<double, 3> scale{1.0, 1.0, 1.0};
};

enum class ActionKind { kWalk, kSit, kStand, kPush, kPause };

/// One thing that a person does; the next begins where and when it ends.
struct ActionDescription {
  ActionKind kind = ActionKind::kStand;
  std::vector<Eigen::Vector2d> path_m{};  ///< walk, push: corners after the present place
  double speed_mps = 1.1;                 ///< walk, push
  double duration_s = 0.0;                ///< sit, stand
  std::string object{};                   ///< sit: on what; push: what
  std::string carry{};                    ///< walk, stand: what both hands hold
  std::string gesture{};  ///< sit, stand: talk, wave, point, type, phone; empty: idle
  double yaw_rad = 0.0;   ///< stand: where to turn
  bool has_yaw = false;
  bool pull = false;  ///< push: walks backwards and drags it along
};

struct PersonDescription {
  std::string name{};
  double height_m = 1.75;
  std::uint64_t look = 0;  ///< which clothes, hair and skin; 0: chosen by name and seed
  FloorPose start{};
  double begin_s = 0.0;  ///< stands still until then
  std::vector<ActionDescription> actions{};
  bool repeat = false;  ///< begins anew after the last action, walking back first
};

/// Something that is put elsewhere, at once: to be used while out of view.
struct RelocationDescription {
  std::string object{};
  double at_s = 0.0;
  FloorPose to{};
};

/// Something that goes to another place by itself, in a straight line and turning evenly, starting
/// and stopping gently: a door, a curtain, a sliding board.
struct MoveDescription {
  std::string object{};
  double from_s = 0.0;
  double to_s = 0.0;
  std::optional<Eigen::Vector2d> to_m{};  ///< absent: stays where it is
  std::optional<double> yaw_rad{};        ///< absent: keeps its yaw
};

/// A camera pose to pass through.
struct CameraWaypoint {
  double at_s = 0.0;
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d look_at_m = Eigen::Vector3d::UnitX();
  double roll_rad = 0.0;
};

struct CameraPathDescription {
  std::vector<CameraWaypoint> waypoints{};  ///< by time, at least one
  std::filesystem::path trajectory_file{};  ///< TUM trajectory instead of waypoints
  double tremor_position_m = 0.002;         ///< standard deviation of a hand's tremor
  double tremor_rotation_rad = 0.003;
  std::vector<std::pair<double, double>> covered_s{};  ///< from-to: a hand before the lens
};

/// The Kinect-class sensor: every part can be switched off (docs/simulation.md has the sources).
struct SensorDescription {
  CameraModel camera{
      .width = 640, .height = 480, .fx = 535.4, .fy = 539.2, .cx = 320.1, .cy = 247.6};
  double rate_hz = 30.0;
  double min_depth_m = 0.45;
  double max_depth_m = 6.5;
  bool depth_noise = true;  ///< disparity noise, growing with z^2
  bool depth_quantisation = true;
  bool depth_holes = true;  ///< projector shadow, silhouettes, grazing angles, glass
  bool depth_range = true;  ///< nothing outside min..max
  bool colour_noise = true;
  bool exposure_drift = true;
  bool vignetting = true;
  bool motion_blur = true;
  bool rolling_shutter = false;  ///< poses are those of the middle row
  double exposure_s = 0.012;     ///< motion blur
  double readout_s = 0.015;      ///< rolling shutter, first to last row
};

/// All of a scene file.
struct SceneDescription {
  std::string name{};
  std::string description{};  ///< a line: what the scene is for
  double duration_s = 10.0;
  std::uint64_t seed = 1;
  std::vector<RoomDescription> rooms{};
  std::vector<OpeningDescription> doors{};
  std::vector<OpeningDescription> windows{};
  std::vector<ObjectDescription> objects{};
  std::vector<PersonDescription> people{};
  std::vector<RelocationDescription> relocations{};
  std::vector<MoveDescription> moves{};  ///< those of one object by time
  CameraPathDescription camera{};
  SensorDescription sensor{};
};

}  // namespace tsg::simulation
