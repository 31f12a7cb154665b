#include "services/slam/lib/saved_map.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "common/core/statistics.hpp"
#include "services/slam/lib/map_encoding.hpp"
#include "services/slam/lib/oriented_brief.hpp"

namespace tsg {
namespace {

constexpr double kOutlierShare = 0.01;  // a few far points would make a room look like a hall

MapFeatureSettings settings_of(const FeatureConfig& features) {
  return {.levels = static_cast<std::uint32_t>(features.levels),
          .scale_factor = features.scale_factor,
          .pattern = descriptor_pattern_id()};
}

/// Room that values take without the outliers at both ends.
double spread(std::vector<double>& values) {
  if (values.empty()) return 0.0;
  std::sort(values.begin(), values.end());
  return quantile(values, 1.0 - kOutlierShare) - quantile(values, kOutlierShare);
}

/// What users want to know of each part, in the order of their numbers.
std::vector<MapPartInfo> describe_parts(const MapContents& contents) {
  struct Extent {
    MapPartInfo info;
    std::array<std::vector<double>, 3> coordinates;
  };
  std::map<MapPart, Extent> parts;
  std::map<KeyframeId, MapPart> part_of;
  for (const Keyframe& keyframe : contents.keyframes) {
    part_of[keyframe.id] = keyframe.part;
    ++parts[keyframe.part].info.keyframes;
  }
  for (const MapPoint& point : contents.points) {
    Extent& extent = parts[part_of.at(point.observations.front().keyframe)];
    ++extent.info.points;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      extent.coordinates[axis].push_back(point.position[static_cast<Eigen::Index>(axis)]);
    }
  }
  std::vector<MapPartInfo> infos;
  for (auto& [part, extent] : parts) {
    extent.info.part = part;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      extent.info.extent_m[static_cast<Eigen::Index>(axis)] = spread(extent.coordinates[axis]);
    }
    infos.push_back(extent.info);
  }
  return infos;
}

std::string describe(const MapFeatureSettings& settings) {
  std::ostringstream text;
  text << "slam.features.levels=" << settings.levels
       << " slam.features.scale_factor=" << settings.scale_factor;
  return text.str();
}

Expected<void> check_settings(const std::filesystem::path& path,
                              const MapFeatureSettings& of_map,
                              const MapFeatureSettings& of_program) {
  if (of_map == of_program) return {};
  const std::string map = "the map file " + path.string();
  if (of_map.pattern != of_program.pattern) {
    return make_error(ExitCode::kBadData,
                      map +
                          " describes corners in another way than this program: load it with the "
                          "TSG-SLAM that saved it, or make the map anew");
  }
  return make_error(ExitCode::kConfig, map + " was made with " + describe(of_map) +
                                           ", slam is set to " + describe(of_program) +
                                           ": set the same, or make the map anew");
}

}  // namespace

Expected<MapFileInfo> save_map(const std::filesystem::path& path,
                               const MapContents& contents,
                               const FeatureConfig& features,
                               std::int64_t created_ns) {
  MapFileInfo info{.created_ns = created_ns,
                   .camera = contents.camera,
                   .features = settings_of(features),
                   .parts = describe_parts(contents)};
  return write_map_file(path, info, encode_map(contents)).map([&] { return std::move(info); });
}

Expected<MapContents> load_map(const std::filesystem::path& path, const FeatureConfig& features) {
  const auto file = read_map_file(path);
  if (!file) return tl::unexpected(file.error());
  const auto checked = check_settings(path, file->info.features, settings_of(features));
  if (!checked) return tl::unexpected(checked.error());
  return decode_map(file->map(), file->info.camera, file->info.features)
      .map_error([&](const Error& error) {
        return Error{error.code, "the map file " + path.string() + " holds a map that cannot be: " +
                                     error.message + "; load another one"};
      });
}

}  // namespace tsg
