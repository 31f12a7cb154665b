#pragma once

// For tests: scenes from text.

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>
#include <string>
#include <vector>

#include "common/scene_file/scene_sections.hpp"
#include "tests/support/temp_folder.hpp"

namespace tsg {

inline const Catalogue kCatalogue{.furniture = {"chair", "cup", "desk", "poster"},
                                  .surfaces = {"carpet", "plaster"}};

inline constexpr const char* kRooms = "rooms: [{min_m: [0, 0], max_m: [6, 5]}]\n";
inline constexpr const char* kCamera =
    "camera: {waypoints: [{at_s: 0, position_m: [1, 1, 1.4], look_at_m: [3, 3, 1]}]}\n";

class SceneFile : public ::testing::Test {
 protected:
  Expected<simulation::SceneDescription> load(const std::string& text) {
    return load_scene_with(kCatalogue, folder_.write("room.yaml", text));
  }

  /// A whole scene with `text` from line 3 on.
  simulation::SceneDescription scene_with(const std::string& text) {
    auto scene = load(kRooms + std::string(kCamera) + text);
    EXPECT_TRUE(scene) << scene.error().message;
    return scene.value_or(simulation::SceneDescription{});
  }

  /// What loading says, "LINE: message" each.
  std::vector<std::string> problems_of(const std::string& text) {
    const auto scene = load(text);
    if (scene) return {};
    EXPECT_EQ(scene.error().code, ExitCode::kConfig);
    std::vector<std::string> lines;
    std::istringstream stream(scene.error().message);
    const std::string start = "  " + (folder_ / "room.yaml").string() + ":";
    std::string line;
    std::getline(stream, line);  // how many there are
    while (std::getline(stream, line)) {
      EXPECT_TRUE(line.starts_with(start)) << line;
      lines.push_back(line.substr(std::min(line.size(), start.size())));
    }
    return lines;
  }

  std::vector<std::string> problems_with(const std::string& text) {
    return problems_of(kRooms + std::string(kCamera) + text);
  }

  test::TempFolder folder_;
};

}  // namespace tsg
