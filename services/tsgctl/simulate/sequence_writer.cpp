#include "services/tsgctl/simulate/sequence_writer.hpp"

#include <algorithm>
#include <iomanip>
#include <limits>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <sstream>
#include <utility>

#include "common/core/atomic_file.hpp"
#include "common/dataset/stamp.hpp"
#include "common/dataset/trajectory.hpp"
#include "services/tsgctl/scene_truth/scene_truth.hpp"
#include "services/tsgctl/simulate/scene_truth_recorder.hpp"

namespace tsg {
namespace {

namespace fs = std::filesystem;
using simulation::SimulatedFrame;
using simulation::SimulatedInstance;

Expected<void> write_image(const fs::path& path, const cv::Mat& image) {
  std::vector<unsigned char> png;
  // Fast compression: noise does not get much smaller by trying harder.
  cv::imencode(".png", image, png, {cv::IMWRITE_PNG_COMPRESSION, 1});
  return write_file_atomically(path, std::string(png.begin(), png.end()));
}

/// Masks have 8 bits, as other tools expect, unless the scene has more instances than that holds.
bool fits_8_bits(const std::vector<SimulatedInstance>& instances) {
  return std::ranges::all_of(instances, [](const SimulatedInstance& instance) {
    return instance.id <= std::numeric_limits<std::uint8_t>::max();
  });
}

cv::Mat to_mask(const cv::Mat& ids, const std::vector<SimulatedInstance>& instances) {
  cv::Mat mask = ids;
  if (fits_8_bits(instances)) ids.convertTo(mask, CV_8U);
  return mask;
}

std::set<int> visible_in(const cv::Mat& ids) {
  std::set<int> visible;
  int last = 0;  // neighbours mostly have the same
  std::for_each(ids.begin<std::uint16_t>(), ids.end<std::uint16_t>(), [&](std::uint16_t id) {
    if (id != last && id != 0) visible.insert(id);
    last = id;
  });
  return visible;
}

}  // namespace

Expected<void> write_truth_of_scene(const simulation::Simulator& simulator,
                                    const std::vector<int>& frames,
                                    const fs::path& folder) {
  SceneTruthRecorder recorder(simulator.world());
  for (const int frame : frames) {
    const std::int64_t since_start_ns = simulator.since_start_ns(frame);
    recorder.add_frame(kSequenceStartNs + since_start_ns,
                       static_cast<double>(since_start_ns) * 1e-9);
  }
  return write_scene_truth(folder, recorder.truth());
}

Expected<void> check_new_folder(const fs::path& folder) {
  std::error_code absent;
  if (!fs::exists(folder, absent)) return {};
  if (fs::is_directory(folder, absent) && fs::is_empty(folder, absent)) return {};
  return make_error(ExitCode::kCannotWrite,
                    folder.string() +
                        " is there already and not an empty folder; remove it, or "
                        "give another");
}

Expected<SequenceWriter> SequenceWriter::open(const fs::path& folder,
                                              const simulation::SensorDescription& sensor,
                                              std::vector<SimulatedInstance> instances) {
  if (auto empty = check_new_folder(folder); !empty) return tl::unexpected(empty.error());
  for (const char* kind : {"rgb", "depth", "mask"}) {
    if (auto made = make_folder(folder / kind); !made) return tl::unexpected(made.error());
  }
  return SequenceWriter(folder, sensor, std::move(instances));
}

SequenceWriter::SequenceWriter(fs::path folder,
                               const simulation::SensorDescription& sensor,
                               std::vector<SimulatedInstance> instances)
    : folder_(std::move(folder)), sensor_(sensor), instances_(std::move(instances)) {}

Expected<void> SequenceWriter::add(const SimulatedFrame& frame) {
  const std::int64_t stamp_ns = kSequenceStartNs + frame.since_start_ns;
  const std::string stamp = format_stamp(stamp_ns, StampDecimals::kMicroseconds);
  const std::string name = stamp + ".png";
  stamps_.push_back(stamp);
  truth_.push_back({stamp_ns, frame.T_world_camera});
  moving_.emplace_back(frame.moving.begin(), frame.moving.end());
  for (const int id : visible_in(frame.ids)) ++frames_visible_[id];
  return write_image(folder_ / "rgb" / name, frame.colour)
      .and_then([&] { return write_image(folder_ / "depth" / name, frame.depth); })
      .and_then(
          [&] { return write_image(folder_ / "mask" / name, to_mask(frame.ids, instances_)); });
}

std::string SequenceWriter::list_of(const std::string& kind) const {
  std::string list = "# stamp, file: a simulated sequence\n";
  for (const std::string& stamp : stamps_) list += stamp + " " + kind + "/" + stamp + ".png\n";
  return list;
}

std::string SequenceWriter::camera_yaml() const {
  const CameraModel& camera = sensor_.camera;
  std::ostringstream yaml;
  yaml << std::setprecision(std::numeric_limits<double>::max_digits10) << "fx: " << camera.fx
       << "\nfy: " << camera.fy << "\ncx: " << camera.cx << "\ncy: " << camera.cy
       << "\nwidth: " << camera.width << "\nheight: " << camera.height
       << "\nfps: " << sensor_.rate_hz << "\ndepth_scale: " << simulation::kDepthUnitsPerMetre
       << "\n";
  return yaml.str();
}

std::string SequenceWriter::instances_json() const {
  nlohmann::json instances = nlohmann::json::object();
  for (const SimulatedInstance& known : instances_) {
    const auto visible = frames_visible_.find(known.id);
    nlohmann::json& instance = instances[std::to_string(known.id)];
    instance = {{"cls", known.class_name},
                {"name", known.name},
                {"dynamic", known.is_dynamic},
                {"frames_visible", visible == frames_visible_.end() ? 0 : visible->second}};
    if (!known.is_dynamic) continue;
    for (std::size_t i = 0; i < stamps_.size(); ++i) {
      instance["moving"][stamps_[i]] = moving_[i].contains(known.id);
    }
  }
  return nlohmann::json{{"instances", instances}}.dump(1) + "\n";
}

Expected<void> SequenceWriter::finish() const {
  const auto write = [&](const char* name, const std::string& text) {
    return write_file_atomically(folder_ / name, text);
  };
  return write("camera.yaml", camera_yaml())
      .and_then([&] { return write("instances.json", instances_json()); })
      .and_then([&] { return write_trajectory(folder_ / "groundtruth.txt", truth_); })
      .and_then([&] { return write("depth.txt", list_of("depth")); })
      .and_then([&] { return write("rgb.txt", list_of("rgb")); });
}

}  // namespace tsg
