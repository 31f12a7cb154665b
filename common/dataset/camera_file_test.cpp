#include "common/dataset/camera_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "tests/support/temp_folder.hpp"

namespace tsg {
namespace {

using test::TempFolder;
using ::testing::HasSubstr;

constexpr const char* kPlain =
    "fx: 517.3\nfy: 516.5\ncx: 318.6\ncy: 255.3\nwidth: 640\nheight: 480\ndepth_scale: 5000\n";

Expected<RecordedCamera> read(const std::string& content) {
  const TempFolder folder;
  return read_camera_file(folder.write("camera.yaml", content));
}

void expect_error(const std::string& content, ExitCode code, const std::string& text) {
  const auto camera = read(content);
  ASSERT_FALSE(camera) << content;
  EXPECT_EQ(camera.error().code, code) << camera.error().message;
  EXPECT_THAT(camera.error().message, HasSubstr(text));
}

TEST(ReadCameraFile, TakesPlainFilesWithDefaultsForDistortionAndRate) {
  const auto camera = read(kPlain);
  ASSERT_TRUE(camera) << camera.error().message;
  EXPECT_EQ(camera->model.width, 640);
  EXPECT_EQ(camera->model.height, 480);
  EXPECT_DOUBLE_EQ(camera->model.fx, 517.3);
  EXPECT_DOUBLE_EQ(camera->model.fy, 516.5);
  EXPECT_DOUBLE_EQ(camera->model.cx, 318.6);
  EXPECT_DOUBLE_EQ(camera->model.cy, 255.3);
  EXPECT_FALSE(camera->model.is_distorted());
  EXPECT_DOUBLE_EQ(camera->depth_units_per_metre, 5000.0);
  EXPECT_DOUBLE_EQ(camera->fps, 30.0);
}

TEST(ReadCameraFile, TakesOpenCvsHeaderDistortionAndRate) {
  const auto camera = read(std::string("%YAML:1.0\n---\n") + kPlain +
                           "k1: 0.26\nk2: -0.95\np1: -0.005\np2: 0.0026\nk3: 1.16\nfps: 15\n"
                           "depth_registered: 1\n");
  ASSERT_TRUE(camera) << camera.error().message;
  EXPECT_EQ(camera->model.distortion, (std::array{0.26, -0.95, -0.005, 0.0026, 1.16}));
  EXPECT_DOUBLE_EQ(camera->fps, 15.0);
}

TEST(ReadCameraFile, AbsentFileIsMissingInputWithTheFix) {
  const TempFolder folder;
  const auto camera = read_camera_file(folder / "camera.yaml");
  ASSERT_FALSE(camera);
  EXPECT_EQ(camera.error().code, ExitCode::kMissingInput);
  EXPECT_THAT(camera.error().message, HasSubstr("write it: fx fy"));
}

TEST(ReadCameraFile, UnknownRepeatedAndMissingKeysAreNamedWithTheirLine) {
  expect_error(std::string("%YAML:1.0\n---\n") + kPlain + "fz: 1\n", ExitCode::kBadData,
               "camera.yaml:10: unknown key \"fz\"");
  expect_error(std::string(kPlain) + "fx: 1\n", ExitCode::kBadData, "camera.yaml:8");
  expect_error("fx: 1\n", ExitCode::kBadData, "is missing");
}

TEST(ReadCameraFile, ValuesThatDoNotWorkAreNamedWithTheirLine) {
  expect_error(std::string(kPlain) + "k1: wide\n", ExitCode::kBadData, "camera.yaml:8: key \"k1\"");
  expect_error(std::string(kPlain) + "k1: [1, 2]\n", ExitCode::kBadData, "camera.yaml:8");
  expect_error(std::string(kPlain) + "k1: nan\n", ExitCode::kInvalidNumber, "camera.yaml:8");
  expect_error(std::string(kPlain) + "fps: 0\n", ExitCode::kBadData, "camera.yaml:8");
  expect_error(std::string(kPlain) + "depth_registered: 0\n", ExitCode::kBadData, "register it");
}

TEST(ReadCameraFile, SizesMustBeWholeAndTheModelSound) {
  std::string content = kPlain;
  expect_error(content.replace(content.find("640"), 3, "6.5"), ExitCode::kBadData,
               "camera.yaml:5: \"width\"");
  content = kPlain;
  expect_error(content.replace(content.find("517.3"), 5, "-3.00"), ExitCode::kBadData, "fx");
}

TEST(ReadCameraFile, WhatIsNoYamlIsBadDataWithTheLine) {
  expect_error("fx: 1\nfy: [\n", ExitCode::kBadData, "camera.yaml:");
  expect_error("just text\n", ExitCode::kBadData, "camera.yaml");
}

}  // namespace
}  // namespace tsg
