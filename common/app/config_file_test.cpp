#include "common/app/config_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "common/core/error.hpp"

namespace tsg {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

class ConfigFileTest : public ::testing::Test {
 protected:
  void TearDown() override { std::filesystem::remove(path_); }

  ConfigFile load(const std::string& text, const std::vector<std::string>& overrides = {}) {
    std::ofstream(path_) << text;
    return ConfigFile::load(path_, overrides);
  }

  static std::string message_of(const std::function<void()>& action, ExitCode expected_code) {
    try {
      action();
    } catch (const FatalError& error) {
      EXPECT_EQ(error.code(), expected_code);
      return error.what();
    }
    ADD_FAILURE() << "nothing was thrown";
    return {};
  }

  std::filesystem::path path_ =
      std::filesystem::temp_directory_path() /
      ("tsg_config_" +
       std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()) + ".yaml");
};

TEST_F(ConfigFileTest, OverwritesOnlyTheKeysThatAreThere) {
  const ConfigFile file = load("slam:\n  count: 5\n  names: [a, b]\n");
  int count = 1;
  double ratio = 0.5;
  std::vector<std::string> names;
  ConfigReader reader(file, "slam");
  reader.read("count", count);
  reader.read("ratio", ratio);
  reader.read("names", names);
  reader.finish();
  EXPECT_EQ(count, 5);
  EXPECT_EQ(ratio, 0.5);
  EXPECT_THAT(names, ElementsAre("a", "b"));
}

TEST_F(ConfigFileTest, OverridesWinOverTheFile) {
  const ConfigFile file = load("slam:\n  count: 5\n", {"slam.count=7"});
  int count = 1;
  ConfigReader reader(file, "slam");
  reader.read("count", count);
  reader.finish();
  EXPECT_EQ(count, 7);
}

TEST_F(ConfigFileTest, TakesAnOverrideWithoutAValueForAnEmptyText) {
  const ConfigFile file = load("camera:\n  folder: somewhere\n", {"camera.folder="});
  std::string folder = "default";
  ConfigReader reader(file, "camera");
  reader.read("folder", folder);
  reader.finish();
  EXPECT_EQ(folder, "");
}

TEST_F(ConfigFileTest, ListsAllProblemsAtOnceWithTheirLines) {
  const ConfigFile file = load("slam:\n  count: many\n  nested:\n    typo: 1\n");
  int count = 1;
  ConfigReader reader(file, "slam");
  reader.read("count", count);
  const std::string message =
      message_of([&] { reader.finish({"ratio must be > 0"}); }, ExitCode::kConfig);
  EXPECT_THAT(message, HasSubstr(path_.string() + ":2: slam.count must be a whole number"));
  EXPECT_THAT(message, HasSubstr(path_.string() + ":4: unknown key slam.nested.typo"));
  EXPECT_THAT(message, HasSubstr("slam.ratio must be > 0"));
}

TEST_F(ConfigFileTest, NamesTheFileThatIsMissing) {
  const std::string message =
      message_of([] { auto file = ConfigFile::load("/no/such.yaml"); }, ExitCode::kMissingInput);
  EXPECT_THAT(message, HasSubstr("/no/such.yaml"));
}

TEST_F(ConfigFileTest, NamesTheLineThatIsNotYaml) {
  const std::string message =
      message_of([this] { auto file = load("slam:\n  count: [1,\n"); }, ExitCode::kConfig);
  EXPECT_THAT(message, HasSubstr(path_.string() + ":"));
  EXPECT_THAT(message, HasSubstr("not valid YAML"));
}

TEST_F(ConfigFileTest, RefusesAnOverrideWithoutAnEqualsSign) {
  EXPECT_THAT(message_of([this] { auto file = load("", {"slam"}); }, ExitCode::kUsage),
              HasSubstr("section.key=value"));
}

TEST_F(ConfigFileTest, FindsSectionsThatNobodyOwns) {
  const ConfigFile file = load("slam:\n  count: 5\nslamm:\n  count: 5\n");
  EXPECT_THAT(file.unknown_sections({"bus", "slam"}),
              ElementsAre(HasSubstr(":4: unknown section 'slamm'")));
}

}  // namespace
}  // namespace tsg
