#include "services/tsgctl/run/output_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/core/error.hpp"
#include "tests/support/temp_folder.hpp"

namespace tsg {
namespace {

using test::TempFolder;

TEST(OutputFolder, RemovesResultsOfAnEarlierRunAndNothingElse) {
  const TempFolder temp;
  temp.write("out/trajectory.txt", "old");
  temp.write("out/logs/slam.log", "old");
  temp.write("out/notes.txt", "mine");
  const OutputFolder out(temp / "out");
  EXPECT_FALSE(std::filesystem::exists(temp / "out/trajectory.txt"));
  EXPECT_FALSE(std::filesystem::exists(temp / "out/logs/slam.log"));
  EXPECT_TRUE(std::filesystem::exists(temp / "out/notes.txt"));
  EXPECT_TRUE(out.files().empty());
}

TEST(OutputFolder, ListsFilesWithTheirSizes) {
  const TempFolder temp;
  const OutputFolder out(temp / "out");
  temp.write("out/map.bt", "12345");
  ASSERT_EQ(out.files().size(), 1U);
  EXPECT_EQ(out.files()[0].name, "map.bt");
  EXPECT_EQ(out.files()[0].bytes, 5U);
}

TEST(OutputFolder, PathThatCannotBeAFolderIsNamed) {
  const TempFolder temp;
  temp.write("file", "x");
  try {
    const OutputFolder out(temp / "file/out");
    FAIL() << "a folder below a file was accepted";
  } catch (const FatalError& error) {
    EXPECT_EQ(error.code(), ExitCode::kCannotWrite);
    EXPECT_THAT(error.what(), ::testing::HasSubstr("file/out"));
  }
}

}  // namespace
}  // namespace tsg
