#include "common/map_file/map_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <filesystem>

#include "tests/support/temp_folder.hpp"

namespace tsg {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

MapFileInfo example() {
  return {.created_ns = 1'700'000'000'123'456'789,
          .camera = {.width = 640,
                     .height = 480,
                     .fx = 517.3,
                     .fy = 516.5,
                     .cx = 318.6,
                     .cy = 255.3,
                     .distortion = {0.2624, -0.9531, -0.0054, 0.0026, 1.1633}},
          .features = {.levels = 8, .scale_factor = 1.2, .pattern = 4711},
          .parts = {{0, 12, 3456, {1.0, 2.0, 3.0}}, {2, 3, 40, {0.5, 0.25, 0.0}}}};
}

class MapFileTest : public ::testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(write_map_file(path_, example(), kMap));
    bytes_ = test::content_of(path_);
  }
  /// The error that a file of these bytes leads to.
  Error refusal(const std::string& bytes) {
    const auto read = read_map_file(folder_.write("other.tsgmap", bytes));
    if (!read) return read.error();
    ADD_FAILURE() << "such a file was read";
    return {};
  }

  static constexpr std::string_view kMap = "what slam makes of it";
  test::TempFolder folder_;
  std::filesystem::path path_ = folder_ / "home.tsgmap";
  std::string bytes_;
};

TEST_F(MapFileTest, ComesBackAsItWasWritten) {
  const auto file = read_map_file(path_);
  ASSERT_TRUE(file) << file.error().message;
  EXPECT_EQ(file->version, kMapFormatVersion);
  EXPECT_EQ(file->info, example());
  EXPECT_EQ(file->map(), kMap);
  EXPECT_EQ(file->info.keyframes(), 15U);
  EXPECT_EQ(file->info.points(), 3496U);
}

TEST_F(MapFileTest, IsRefusedWithAnyBitTurnedOver) {
  for (std::size_t i = 0; i < bytes_.size(); ++i) {
    std::string bytes = bytes_;
    bytes[i] = static_cast<char>(bytes[i] ^ (1 << (i % 8)));
    const Error error = refusal(bytes);
    EXPECT_EQ(error.code, ExitCode::kBadData) << "byte " << i;
    EXPECT_THAT(error.message, HasSubstr("other.tsgmap")) << "byte " << i;
  }
}

TEST_F(MapFileTest, IsRefusedWhereItIsCutShortAnywhere) {
  for (std::size_t length = 0; length < bytes_.size(); ++length) {
    EXPECT_EQ(refusal(bytes_.substr(0, length)).code, ExitCode::kBadData) << length << " bytes";
  }
  EXPECT_THAT(refusal(bytes_.substr(0, 100)).message,
              AllOf(HasSubstr("damaged"), HasSubstr("100 bytes"), HasSubstr("copy it again")));
}

TEST_F(MapFileTest, IsRefusedWithSomethingBehindIt) {
  EXPECT_THAT(refusal(bytes_ + "x").message, HasSubstr("damaged"));
}

TEST_F(MapFileTest, NewerOneIsRefusedWithBothVersions) {
  std::string bytes = bytes_;
  bytes[8] = static_cast<char>(kMapFormatVersion + 1);
  EXPECT_THAT(refusal(bytes).message,
              AllOf(HasSubstr("has format " + std::to_string(kMapFormatVersion + 1)),
                    HasSubstr("up to format " + std::to_string(kMapFormatVersion)),
                    HasSubstr("newer one")));
}

TEST_F(MapFileTest, SizesThatOverflowAreRefused) {
  std::string bytes = bytes_;
  for (std::size_t i = 16; i < 32; ++i) bytes[i] = static_cast<char>(0xff);
  EXPECT_THAT(refusal(bytes).message, HasSubstr("than its header says"));
}

TEST_F(MapFileTest, OtherFilesAreNotTakenForDamagedMaps) {
  EXPECT_THAT(refusal("").message, HasSubstr("it is empty"));
  EXPECT_THAT(refusal("stamp tx ty tz qx qy qz qw\n").message, HasSubstr("is no map file"));
  const auto folder = read_map_file(folder_.path());
  ASSERT_FALSE(folder);
  EXPECT_EQ(folder.error().code, ExitCode::kBadData);
  EXPECT_EQ(read_map_file("/dev/zero").error().code, ExitCode::kBadData);
}

TEST_F(MapFileTest, AbsentFileIsNamed) {
  const auto absent = read_map_file(folder_ / "absent.tsgmap");
  ASSERT_FALSE(absent);
  EXPECT_EQ(absent.error().code, ExitCode::kMissingInput);
  EXPECT_THAT(absent.error().message,
              AllOf(HasSubstr("absent.tsgmap"), HasSubstr("check the path")));
}

TEST_F(MapFileTest, FullDiskLeavesTheOldMap) {
  rlimit before{};
  ::getrlimit(RLIMIT_FSIZE, &before);
  const auto old_handler = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit limit{100'000, before.rlim_max};
  ::setrlimit(RLIMIT_FSIZE, &limit);
  const auto written = write_map_file(path_, example(), std::string(200'000, 'x'));
  ::setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, old_handler);
  ASSERT_FALSE(written);
  EXPECT_EQ(written.error().code, ExitCode::kCannotWrite);
  EXPECT_THAT(written.error().message, HasSubstr("home.tsgmap"));
  EXPECT_EQ(test::content_of(path_), bytes_);
}

TEST_F(MapFileTest, FullDeviceAndAbsentFolderAreTold) {
  const auto full = write_map_file("/dev/full", example(), kMap);
  ASSERT_FALSE(full);
  EXPECT_THAT(full.error().message, HasSubstr("free some disk space"));
  const auto absent = write_map_file(folder_ / "absent" / "a.tsgmap", example(), kMap);
  ASSERT_FALSE(absent);
  EXPECT_THAT(absent.error().message, HasSubstr("create the folder first"));
  // sysfs lets nobody create files, root included.
  const auto read_only = write_map_file("/sys/kernel/a.tsgmap", example(), kMap);
  ASSERT_FALSE(read_only);
  EXPECT_THAT(read_only.error().message, HasSubstr("make the folder writable"));
}

}  // namespace
}  // namespace tsg
