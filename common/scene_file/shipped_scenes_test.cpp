// Scenes that users meet: those of config/scenes and the one in docs/simulation.md.
#include <gtest/gtest.h>

#include <set>

#include "common/scene_file/scene_file.hpp"
#include "common/scene_file/scene_library.hpp"
#include "common/simulation/furniture/catalogue.hpp"
#include "common/simulation/furniture/room.hpp"
#include "tests/support/temp_folder.hpp"

namespace tsg {
namespace {

const std::filesystem::path kSource = TSG_SOURCE_DIR;

std::string manual() { return test::content_of(kSource / "docs/simulation.md"); }

TEST(ShippedScenes, AllLoadAndSayWhatTheyTest) {
  std::set<std::string> names;
  const SceneLibrary library({kSource / "config/scenes"});
  for (const auto& file : library.files()) {
    const auto scene = load_scene(file);
    ASSERT_TRUE(scene) << scene.error().message;
    EXPECT_EQ(scene->name, file.stem()) << file;
    EXPECT_FALSE(scene->description.empty()) << file;
    names.insert(scene->name);
  }
  for (const char* name :
       {"office_walking_xyz", "office_walking_static", "office_walking_halfsphere",
        "office_sitting_xyz", "moved_chair", "crowd", "corridor_loop", "dark_blackout",
        "scale_round", "demo", "pushed_chair_close", "cart", "door", "busy_office"}) {
    EXPECT_TRUE(names.contains(name)) << name;
  }
}

TEST(ShippedScenes, CorridorLoopLeadsSixtyMetresAndBack) {
  const auto scene = load_scene(kSource / "config/scenes/corridor_loop.yaml");
  ASSERT_TRUE(scene) << scene.error().message;
  const auto& waypoints = scene->camera.waypoints;
  double length_m = 0.0;
  for (std::size_t i = 1; i < waypoints.size(); ++i) {
    length_m += (waypoints[i].position_m - waypoints[i - 1].position_m).norm();
  }
  EXPECT_GE(length_m, 60.0);
  const double apart_m = (waypoints.back().position_m - waypoints.front().position_m).norm();
  EXPECT_LT(apart_m, 2.5) << "it ends in view of where it began";
}

TEST(ShippedScenes, ScaleRoundEndsWhereItBegins) {
  const auto scene = load_scene(kSource / "config/scenes/scale_round.yaml");
  ASSERT_TRUE(scene) << scene.error().message;
  const auto& first = scene->camera.waypoints.front();
  const auto& last = scene->camera.waypoints.back();
  EXPECT_EQ(first.position_m, last.position_m);
  EXPECT_EQ(first.look_at_m, last.look_at_m);
  EXPECT_EQ(last.at_s, scene->duration_s);
  EXPECT_TRUE(scene->people.empty()) << "who would jump back with each lap";
}

TEST(Manual, ShowsASceneThatLoads) {
  const std::string text = manual();
  const std::string fence = "```yaml\n";
  const std::size_t begin = text.find(fence) + fence.size();
  const test::TempFolder folder;
  const auto scene =
      load_scene(folder.write("study.yaml", text.substr(begin, text.find("```", begin) - begin)));
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_EQ(scene->people.size(), 1U);
}

TEST(Manual, NamesEveryShippedScene) {
  const std::string text = manual();
  const SceneLibrary library({kSource / "config/scenes"});
  for (const auto& file : library.files()) {
    EXPECT_NE(text.find("| `" + file.stem().string() + "` |"), std::string::npos) << file;
  }
}

TEST(Manual, NamesEveryTypeAndSurface) {
  const std::string text = manual();
  for (const auto& names : {simulation::furniture_types(), simulation::surface_names()}) {
    for (const std::string& name : names) {
      EXPECT_NE(text.find(name), std::string::npos) << name;
    }
  }
}

}  // namespace
}  // namespace tsg
