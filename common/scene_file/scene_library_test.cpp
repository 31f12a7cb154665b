#include "common/scene_file/scene_library.hpp"

#include <gtest/gtest.h>

#include "tests/support/temp_folder.hpp"

namespace tsg {
namespace {

using test::TempFolder;

class SceneLibraryTest : public ::testing::Test {
 protected:
  SceneLibraryTest() {
    mine_ = folder_.write("mine/office.yaml", "");
    folder_.write("mine/notes.txt", "");
    folder_.write("shipped/office.yaml", "");
    hall_ = folder_.write("shipped/hall.yaml", "");
  }

  TempFolder folder_;
  std::filesystem::path mine_;
  std::filesystem::path hall_;
};

TEST_F(SceneLibraryTest, ListsScenesByNameAndPrefersTheFirstFolder) {
  const SceneLibrary library({folder_ / "none", folder_ / "mine", folder_ / "shipped"});
  EXPECT_EQ(library.files(), (std::vector<std::filesystem::path>{hall_, mine_}));
  EXPECT_EQ(library.find("office").value(), mine_);
}

TEST_F(SceneLibraryTest, TakesAnyFileByItsPath) {
  const SceneLibrary library({});
  EXPECT_EQ(library.find(hall_.string()).value(), hall_);
}

TEST_F(SceneLibraryTest, SceneThatIsNotThereIsMissingInputWithTheOthers) {
  const SceneLibrary library({folder_ / "shipped"});
  const auto kitchen = library.find("kitchen");
  ASSERT_FALSE(kitchen);
  EXPECT_EQ(kitchen.error().code, ExitCode::kMissingInput);
  EXPECT_EQ(kitchen.error().message,
            "there is no scene \"kitchen\"; known: hall office (tsgctl simulate --list tells of "
            "all; a file of your own: its path)");
  EXPECT_EQ(library.find("/no/room.yaml").error().message,
            "there is no file /no/room.yaml; give a scene (docs/simulation.md)");
}

}  // namespace
}  // namespace tsg
