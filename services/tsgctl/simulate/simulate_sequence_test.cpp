#include "services/tsgctl/simulate/simulate_sequence.hpp"

#include <gtest/gtest.h>

#include <map>

#include "common/dataset/tum_folder.hpp"
#include "common/scene_file/scene_file.hpp"
#include "services/tsgctl/simulate/scene_options.hpp"
#include "tests/support/temp_folder.hpp"

namespace tsg {
namespace {

using test::TempFolder;

constexpr const char* kScene = R"(duration_s: 2
rooms:
  - {min_m: [0, 0], max_m: [4, 3]}
objects:
  - {type: office_chair, name: chair, at_m: [2.5, 1.5]}
people:
  - start: {at_m: [2, 2.4], yaw_deg: -90}
    actions:
      - walk: {path_m: [[3.2, 0.6]]}
camera:
  waypoints:
    - {at_s: 0, position_m: [0.5, 1.5, 1.4], look_at_m: [3, 1.5, 1]}
sensor: {width: 160, height: 120}
)";

/// Content of all files, by path relative to the folder.
std::map<std::filesystem::path, std::string> files_of(const std::filesystem::path& folder) {
  std::map<std::filesystem::path, std::string> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (!entry.is_regular_file()) continue;
    files[std::filesystem::relative(entry.path(), folder)] = test::content_of(entry.path());
  }
  return files;
}

class SimulatedSequence : public ::testing::Test {
 protected:
  simulation::Simulator simulator(std::uint64_t seed) {
    auto scene = value_or_throw(load_scene(temp_.write("scene.yaml", kScene)));
    scene.seed = seed;
    return value_or_throw(simulation::Simulator::build(scene));
  }

  /// Renders three frames.
  std::filesystem::path render(simulation::Simulator simulator, const std::string& name) {
    throw_on_error(
        simulate_sequence(simulator, 3, temp_ / name, [this](int done) { done_ = done; }));
    return temp_ / name;
  }

  TempFolder temp_;
  int done_ = 0;
};

TEST_F(SimulatedSequence, OfOneSeedIsTheSameToTheByteAndOfAnotherDiffers) {
  const auto first = files_of(render(simulator(5), "first"));
  const auto second = files_of(render(simulator(5), "second"));
  const auto other = files_of(render(simulator(6), "other"));
  EXPECT_EQ(first.size(), 3U * 3U + 8U);
  EXPECT_EQ(first, second);
  EXPECT_NE(first, other);
  EXPECT_EQ(done_, 3);
}

TEST_F(SimulatedSequence, IsOneThatTheLoaderTakesAndIsNeverOverwritten) {
  auto room = simulator(5);
  ASSERT_TRUE(simulate_sequence(room, 3, temp_ / "room", [](int /*done*/) {}));
  const auto folder = open_tum_folder(temp_ / "room");
  ASSERT_TRUE(folder) << folder.error().message;
  EXPECT_EQ(folder->frames.size(), 3U);
  const auto frame = read_frame(*folder, 2);
  ASSERT_TRUE(frame) << frame.error().message;
  EXPECT_EQ(frame->colour.size(), cv::Size(160, 120));

  const auto again = simulate_sequence(room, 3, temp_ / "room", [](int /*done*/) {});
  ASSERT_FALSE(again);
  EXPECT_EQ(again.error().code, ExitCode::kCannotWrite);
}

TEST_F(SimulatedSequence, ThatCannotBeWrittenAnyLongerEndsEarly) {
  auto room = simulator(5);
  int done = 0;
  const auto lost = simulate_sequence(room, 1000, temp_ / "lost", [&](int frames) {
    done = frames;
    std::filesystem::remove_all(temp_ / "lost");  // while frames are written
  });
  ASSERT_FALSE(lost);
  EXPECT_EQ(lost.error().code, ExitCode::kCannotWrite);
  EXPECT_LT(done, 100);
}

}  // namespace
}  // namespace tsg
