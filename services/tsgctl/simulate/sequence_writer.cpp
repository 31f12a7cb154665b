#include "services/tsgctl/simulate/sequence_writer.hpp"

#include <cstdint>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <vector>

#include "common/core/atomic_file.hpp"
#include "common/core/error.hpp"
#include "common/dataset/stamp.hpp"
#include "common/dataset/trajectory.hpp"
#include "services/tsgctl/simulate/room.hpp"

namespace tsg {
namespace {

namespace fs = std::filesystem;

constexpr std::int64_t kStartNs = 1'700'000'000'000'000'000;
constexpr std::int64_t kPeriodNs = 33'333'000;  // whole microseconds, as the lists have them

/// A camera with the field of view of a Kinect at any size.
CameraModel camera_of(const SimulationOptions& options) {
  CameraModel camera;
  camera.width = options.width;
  camera.height = options.height;
  camera.fx = 0.82 * options.width;
  camera.fy = camera.fx;
  camera.cx = 0.5 * (options.width - 1);
  camera.cy = 0.5 * (options.height - 1);
  return camera;
}

void write_text(const fs::path& path, const std::string& text) {
  throw_on_error(write_file_atomically(path, text));
}

void write_image(const fs::path& path, const cv::Mat& image) {
  std::vector<unsigned char> png;
  // Fast compression: the files are read more often than kept.
  cv::imencode(".png", image, png, {cv::IMWRITE_PNG_COMPRESSION, 1});
  write_text(path, std::string(png.begin(), png.end()));
}

std::string camera_yaml(const CameraModel& camera) {
  return "fx: " + std::to_string(camera.fx) + "\nfy: " + std::to_string(camera.fy) +
         "\ncx: " + std::to_string(camera.cx) + "\ncy: " + std::to_string(camera.cy) +
         "\nwidth: " + std::to_string(camera.width) + "\nheight: " + std::to_string(camera.height) +
         "\nfps: 30.0\ndepth_scale: 5000.0\n";
}

std::string instances_json(const Room& room, const std::vector<std::string>& stamps) {
  nlohmann::json instances = nlohmann::json::object();
  for (const auto& [id, class_name] : room.classes()) {
    nlohmann::json& instance = instances[std::to_string(id)];
    instance = {{"cls", class_name}, {"name", class_name}, {"dynamic", Room::moves(id)}};
    if (!Room::moves(id)) continue;
    for (const std::string& stamp : stamps) instance["moving"][stamp] = true;
  }
  return nlohmann::json{{"instances", instances}}.dump(1) + "\n";
}

}  // namespace

void write_simulated_sequence(const fs::path& folder, const SimulationOptions& options) {
  for (const char* name : {"rgb", "depth", "mask"}) throw_on_error(make_folder(folder / name));
  const Room room;
  const CameraModel camera = camera_of(options);
  std::string colour_list = "# colour images of a simulated room\n";
  std::string depth_list = "# depth images of a simulated room, 5000 = 1 m\n";
  std::vector<std::string> stamps;
  Trajectory truth;
  for (int frame = 0; frame < options.frames; ++frame) {
    const std::int64_t since_start_ns = frame * kPeriodNs;
    const double time_s = static_cast<double>(since_start_ns) * 1e-9;
    const SE3 T_world_camera = Room::T_world_camera(time_s);
    const RoomView view = room.render(camera, T_world_camera, time_s);
    const std::string stamp = format_stamp(kStartNs + since_start_ns, StampDecimals::kMicroseconds);
    const std::string name = stamp + ".png";
    write_image(folder / "rgb" / name, view.colour);
    write_image(folder / "depth" / name, view.depth);
    write_image(folder / "mask" / name, view.ids);
    colour_list += stamp + " rgb/" + name + "\n";
    depth_list += stamp + " depth/" + name + "\n";
    stamps.push_back(stamp);
    truth.push_back({kStartNs + since_start_ns, T_world_camera});
  }
  write_text(folder / "rgb.txt", colour_list);
  write_text(folder / "depth.txt", depth_list);
  write_text(folder / "camera.yaml", camera_yaml(camera));
  write_text(folder / "instances.json", instances_json(room, stamps));
  throw_on_error(write_trajectory(folder / "groundtruth.txt", truth));
}

}  // namespace tsg
