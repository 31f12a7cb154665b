#include "common/app/shipped_files.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace tsg {
namespace {

TEST(ShippedFiles, AreFoundInTheSourceFolderOfABuild) {
  const auto file = find_config_file("roudi.toml");
  ASSERT_TRUE(file) << file.error().message;
  EXPECT_TRUE(std::filesystem::is_regular_file(*file));
}

TEST(ShippedFiles, HaveANetworkSmallEnoughToBeShippedWithTheSource) {
  const auto file = find_shipped_network();
  ASSERT_TRUE(file) << file.error().message;
  EXPECT_LE(std::filesystem::file_size(*file), 20'000'000U);
}

TEST(ShippedFiles, ThatAreAbsentAreNamedWithThePlacesSearched) {
  const auto file = find_config_file("nothing.toml");
  ASSERT_FALSE(file);
  EXPECT_EQ(file.error().code, ExitCode::kMissingInput);
  for (const auto& folder : config_folders()) {
    EXPECT_THAT(file.error().message, ::testing::HasSubstr((folder / "nothing.toml").string()));
  }
}

TEST(ShippedFiles, LieBesideTheProgramFirst) {
  EXPECT_EQ(config_folders().front(),
            (program_folder() / "../share/tsg-slam/config").lexically_normal());
}

}  // namespace
}  // namespace tsg
