#include "common/dataset/trajectory.hpp"

#include <algorithm>
#include <array>
#include <iomanip>
#include <ostream>
#include <string>

#include "common/core/atomic_file.hpp"
#include "common/dataset/text_file.hpp"

namespace tsg {
namespace {

constexpr std::size_t kFieldsPerPose = 8;
constexpr const char* kFormat = "a pose is \"stamp tx ty tz qx qy qz qw\"";

Expected<StampedPose> parse_pose(const DataLine& line, const std::string& where) {
  if (line.fields.size() != kFieldsPerPose) {
    return make_error(ExitCode::kBadData, where + ": " + std::to_string(line.fields.size()) +
                                              " fields instead of 8; " + kFormat);
  }
  const auto stamp_number = parse_number(line.fields[0], where);
  if (!stamp_number) return tl::unexpected(stamp_number.error());
  const auto stamp_ns = parse_stamp_ns(line.fields[0]);
  if (!stamp_ns) {
    return make_error(ExitCode::kBadData,
                      where + ": the stamp " + line.fields[0] + " is not in seconds; " + kFormat);
  }
  std::array<double, kFieldsPerPose - 1> values{};
  for (std::size_t i = 0; i < values.size(); ++i) {
    const auto value = parse_number(line.fields[i + 1], where);
    if (!value) return tl::unexpected(value.error());
    values[i] = *value;
  }
  const Eigen::Vector3d translation(values[0], values[1], values[2]);
  const Eigen::Quaterniond rotation(values[6], values[3], values[4], values[5]);
  if (rotation.norm() < 1e-6) {
    return make_error(ExitCode::kBadData,
                      where + ": the quaternion is zero, which is no rotation; " + kFormat);
  }
  return StampedPose{*stamp_ns, SE3(rotation, translation)};
}

void sort_and_drop_repeats(Trajectory& trajectory) {
  std::stable_sort(trajectory.begin(), trajectory.end(),
                   [](const auto& a, const auto& b) { return a.stamp_ns < b.stamp_ns; });
  const auto same_stamp = [](const auto& a, const auto& b) { return a.stamp_ns == b.stamp_ns; };
  trajectory.erase(std::unique(trajectory.begin(), trajectory.end(), same_stamp), trajectory.end());
}

void write_pose(std::ostream& stream, const StampedPose& pose, StampDecimals decimals) {
  const Eigen::Vector3d& t = pose.T_world_camera.translation();
  const Eigen::Quaterniond& q = pose.T_world_camera.rotation();
  stream << format_stamp(pose.stamp_ns, decimals) << std::fixed << std::setprecision(9);
  for (const double value : {t.x(), t.y(), t.z(), q.x(), q.y(), q.z(), q.w()}) {
    stream << ' ' << value;
  }
  stream << '\n';
}

}  // namespace

Expected<Trajectory> read_trajectory(const std::filesystem::path& path) {
  const auto lines = read_data_lines(path, "name a trajectory file in TUM format");
  if (!lines) return tl::unexpected(lines.error());
  Trajectory trajectory;
  trajectory.reserve(lines->size());
  for (const DataLine& line : *lines) {
    const auto pose = parse_pose(line, place(path, line.number));
    if (!pose) return tl::unexpected(pose.error());
    trajectory.push_back(*pose);
  }
  if (trajectory.empty()) {
    return make_error(ExitCode::kEmptyInput,
                      path.string() + " holds no pose; name a trajectory that has some");
  }
  sort_and_drop_repeats(trajectory);
  return trajectory;
}

Expected<Trajectory> read_ground_truth(const std::filesystem::path& file_or_folder) {
  std::error_code ignored;
  const bool is_folder = std::filesystem::is_directory(file_or_folder, ignored);
  return read_trajectory(is_folder ? file_or_folder / "groundtruth.txt" : file_or_folder);
}

Expected<void> write_trajectory(const std::filesystem::path& path,
                                const Trajectory& trajectory,
                                StampDecimals decimals) {
  for (const StampedPose& pose : trajectory) {
    if (pose.T_world_camera.is_finite()) continue;
    return make_error(ExitCode::kInvalidNumber, "the pose of stamp " +
                                                    format_stamp(pose.stamp_ns, decimals) +
                                                    " is not finite, so " + path.string() +
                                                    " was not written; report this with the input");
  }
  return write_file_atomically(path, [&](std::ostream& stream) {
    stream << "# stamp tx ty tz qx qy qz qw\n";
    for (const StampedPose& pose : trajectory) write_pose(stream, pose, decimals);
  });
}

}  // namespace tsg
