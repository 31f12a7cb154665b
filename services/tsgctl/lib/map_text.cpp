#include "services/tsgctl/lib/map_text.hpp"

#include <array>
#include <ctime>
#include <nlohmann/json.hpp>
#include <vector>

#include "services/tsgctl/lib/text_format.hpp"

namespace tsg {
namespace {

constexpr std::int64_t kNsPerSecond = 1'000'000'000;

/// "2026-11-22T14:03:12Z"
std::string format_time(std::int64_t utc_ns) {
  const auto seconds = static_cast<std::time_t>(utc_ns / kNsPerSecond);
  std::tm parts{};
  ::gmtime_r(&seconds, &parts);
  std::array<char, 32> text{};
  const std::size_t length = std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%SZ", &parts);
  return {text.data(), length};
}

std::string format_extent(const Eigen::Vector3d& extent_m) {
  return fixed(extent_m.x(), 1) + " x " + fixed(extent_m.y(), 1) + " x " + fixed(extent_m.z(), 1) +
         " m";
}

nlohmann::json to_json(const CameraModel& camera) {
  return {{"width", camera.width},
          {"height", camera.height},
          {"fx", camera.fx},
          {"fy", camera.fy},
          {"cx", camera.cx},
          {"cy", camera.cy},
          {"distortion", camera.distortion}};
}

}  // namespace

std::string to_text(const MapFileReport& report) {
  const MapFileInfo& info = report.info;
  std::vector<std::vector<std::string>> rows = {
      {"created", format_time(info.created_ns)},
      {"format", std::to_string(report.version)},
      {"size", format_bytes(report.bytes)},
      {"camera", info.camera.describe()},
      {"features", std::to_string(info.features.levels) + " levels, scale factor " +
                       fixed(info.features.scale_factor, 2)},
      {"keyframes", std::to_string(info.keyframes())},
      {"points", std::to_string(info.points())},
      {"parts", std::to_string(info.parts.size())}};
  for (const MapPartInfo& part : info.parts) {
    rows.push_back({"part " + std::to_string(part.part),
                    std::to_string(part.keyframes) + " keyframes, " + std::to_string(part.points) +
                        " points, extent " + format_extent(part.extent_m)});
  }
  return report.path + "\n" + format_table(rows, 2);
}

nlohmann::json to_json(const MapFileReport& report) {
  const MapFileInfo& info = report.info;
  nlohmann::json parts = nlohmann::json::array();
  for (const MapPartInfo& part : info.parts) {
    parts.push_back({{"part", part.part},
                     {"keyframes", part.keyframes},
                     {"points", part.points},
                     {"extent_m", {part.extent_m.x(), part.extent_m.y(), part.extent_m.z()}}});
  }
  return {{"file", report.path},
          {"bytes", report.bytes},
          {"format", report.version},
          {"created", format_time(info.created_ns)},
          {"camera", to_json(info.camera)},
          {"features",
           {{"levels", info.features.levels}, {"scale_factor", info.features.scale_factor}}},
          {"keyframes", info.keyframes()},
          {"points", info.points()},
          {"parts", std::move(parts)}};
}

}  // namespace tsg
