#include "services/tsgctl/simulate/scene_options.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <sstream>
#include <utility>

namespace tsg {
namespace {

using simulation::SensorDescription;

constexpr std::array<std::pair<const char*, bool SensorDescription::*>, 9> kParts{{
    {"depth_noise", &SensorDescription::depth_noise},
    {"depth_quantisation", &SensorDescription::depth_quantisation},
    {"depth_holes", &SensorDescription::depth_holes},
    {"depth_range", &SensorDescription::depth_range},
    {"colour_noise", &SensorDescription::colour_noise},
    {"exposure_drift", &SensorDescription::exposure_drift},
    {"vignetting", &SensorDescription::vignetting},
    {"motion_blur", &SensorDescription::motion_blur},
    {"rolling_shutter", &SensorDescription::rolling_shutter},
}};

Expected<void> apply_noise(const std::string& noise, SensorDescription& sensor) {
  for (const auto& [name, part] : kParts) sensor.*part = noise == "all";
  if (noise == "all" || noise == "none") return {};
  std::istringstream names(noise);
  for (std::string name; std::getline(names, name, ',');) {
    const auto* const found =
        std::ranges::find_if(kParts, [&](const auto& part) { return name == part.first; });
    if (found == kParts.end()) {
      std::string known;
      for (const auto& [part_name, part] : kParts) known += std::string(" ") + part_name;
      return make_error(ExitCode::kUsage,
                        "--noise: there is no \"" + name + "\"; known: all none" + known);
    }
    sensor.*(found->second) = true;
  }
  return {};
}

std::optional<int> parse_pixels(std::string_view text, int most) {
  constexpr int kLeast = 16;
  int pixels = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), pixels);
  if (error != std::errc() || end != text.data() + text.size()) return {};
  if (pixels < kLeast || pixels > most) return {};
  return pixels;
}

Expected<void> apply_size(const std::string& size, SensorDescription& sensor) {
  const std::size_t cross = size.find('x');
  if (cross != std::string::npos) {
    const auto width = parse_pixels(std::string_view(size).substr(0, cross), 1280);
    const auto height = parse_pixels(std::string_view(size).substr(cross + 1), 720);
    if (width && height) {
      sensor.camera = sensor.camera.resized(*width, *height);
      return {};
    }
  }
  return make_error(ExitCode::kUsage, "--size \"" + size +
                                          "\": write WIDTHxHEIGHT, 16x16 to 1280x720, e.g. "
                                          "320x240");
}

}  // namespace

Expected<void> apply(const SceneOptions& options, simulation::SceneDescription& scene) {
  if (options.seed) scene.seed = *options.seed;
  if (!options.noise.empty()) {
    if (auto applied = apply_noise(options.noise, scene.sensor); !applied) return applied;
  }
  return options.size.empty() ? Expected<void>{} : apply_size(options.size, scene.sensor);
}

}  // namespace tsg
