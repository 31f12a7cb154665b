#include "services/tsgctl/slam_options.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <CLI/CLI.hpp>

#include "common/core/error.hpp"
#include "services/slam/lib/dynamic/method.hpp"

namespace tsg {
namespace {

using ::testing::HasSubstr;

SlamOptions parse(const std::string& arguments) {
  CLI::App app;
  SlamOptions options;
  add_method_option(app, options.method);
  add_slam_options(app, options);
  app.parse(arguments);
  return options;
}

void expect_usage_error(const SlamOptions& options, const std::string& says) {
  try {
    (void)options.load();
    FAIL() << "loaded";
  } catch (const FatalError& error) {
    EXPECT_EQ(error.code(), ExitCode::kUsage);
    EXPECT_THAT(error.what(), HasSubstr(says));
  }
}

TEST(SlamOptions, MethodIsShortForItsSetting) {
  for (const std::string_view name : kDynamicMethodNames) {
    const std::string method(name);
    const SlamConfig by_option = parse("--method " + method).load();
    const SlamConfig by_setting = parse("--set slam.dynamic_filter.method=" + method).load();
    EXPECT_EQ(name_of(by_option.dynamic_filter.method), method);
    EXPECT_EQ(name_of(by_setting.dynamic_filter.method), method);
  }
}

TEST(SlamOptions, SettingsReachTheCore) {
  const SlamConfig config = parse("--method mask --set slam.features.max_features=800").load();
  EXPECT_EQ(config.features.max_features, 800);
  EXPECT_EQ(config.dynamic_filter.method, DynamicMethod::kMask);
}

TEST(SlamOptions, AnUnknownMethodIsRefusedWithThoseThereAre) {
  try {
    (void)parse("--method magic");
    FAIL() << "accepted";
  } catch (const CLI::ValidationError& error) {
    EXPECT_THAT(error.what(), HasSubstr("magic"));
    EXPECT_THAT(error.what(), HasSubstr("epipolar"));
  }
}

TEST(SlamOptions, TheMethodCannotBeSetTwice) {
  expect_usage_error(parse("--method tsg --set slam.dynamic_filter.method=none"),
                     "give one of them");
}

TEST(SlamOptions, SettingsOfOtherSectionsAreRefused) {
  expect_usage_error(parse("--set camera.pace=lockstep"), "only slam runs here");
}

TEST(MaskArguments, FaultsAreThoseOfSegmentation) {
  CLI::App app;
  MaskArguments arguments;
  add_mask_options(app, arguments);
  app.parse("--mask-fault late_frames=6 --mask-fault merge_two=true");
  const MaskOptions options = arguments.load();
  EXPECT_TRUE(options.use);
  EXPECT_EQ(options.faults.late_frames, 6);
  EXPECT_TRUE(options.faults.merge_two);
}

TEST(MaskArguments, MasksCanBeLeftOut) {
  CLI::App app;
  MaskArguments arguments;
  add_mask_options(app, arguments);
  app.parse("--no-masks");
  EXPECT_FALSE(arguments.load().use);
}

}  // namespace
}  // namespace tsg
