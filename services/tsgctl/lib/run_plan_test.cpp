#include "services/tsgctl/lib/run_plan.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace tsg {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsSupersetOf;
using ::testing::Not;

RunOptions options_of(SegmentationSource segmentation) {
  RunOptions options;
  options.input = "/data/sequence";
  options.out = "/tmp/out";
  options.segmentation = segmentation;
  if (segmentation == SegmentationSource::kModel) options.model = "/models/yolo.onnx";
  return options;
}

std::vector<std::string> names_of(const RunPlan& plan) {
  std::vector<std::string> names;
  for (const ProcessPlan& process : plan.processes) names.push_back(process.service);
  return names;
}

std::vector<std::string> arguments_of(const RunPlan& plan, const std::string& service) {
  for (const ProcessPlan& process : plan.processes) {
    if (process.service == service) return process.arguments;
  }
  ADD_FAILURE() << service << " is not in the plan";
  return {};
}

RunPlan planned(const RunOptions& options) {
  auto plan = make_run_plan(options, "/opt/tsg/bin");
  EXPECT_TRUE(plan.has_value()) << plan.error().message;
  return plan.value_or(RunPlan{});
}

TEST(RunPlan, StartsTheCameraLast) {
  const RunPlan plan = planned(options_of(SegmentationSource::kDataset));
  EXPECT_THAT(names_of(plan), ElementsAre("segmentation", "slam", "map_server", "camera"));
  EXPECT_EQ(plan.camera().executable, "/opt/tsg/bin/tsg-camera");
}

TEST(RunPlan, SegmentationOffStartsNoSegmentationAndExpectsNoMasks) {
  const RunPlan plan = planned(options_of(SegmentationSource::kOff));
  EXPECT_THAT(names_of(plan), ElementsAre("slam", "map_server", "camera"));
  EXPECT_THAT(arguments_of(plan, "slam"), Contains("slam.expect_masks=false"));
  EXPECT_THAT(arguments_of(plan, "camera"), Contains("camera.wait_for_subscribers=1"));
}

TEST(RunPlan, LockstepReachesBothEndsOfTheHandshake) {
  RunOptions options = options_of(SegmentationSource::kDataset);
  options.pace = Pace::kLockstep;
  const RunPlan plan = planned(options);
  EXPECT_THAT(arguments_of(plan, "camera"), Contains("camera.pace=lockstep"));
  EXPECT_THAT(arguments_of(plan, "slam"),
              IsSupersetOf({"slam.lockstep=true", "slam.expect_masks=true"}));
}

TEST(RunPlan, InputReachesTheCameraAndTheProviderOfTrueMasks) {
  const RunPlan plan = planned(options_of(SegmentationSource::kDataset));
  EXPECT_THAT(arguments_of(plan, "camera"), IsSupersetOf({"camera.replay.folder=/data/sequence",
                                                          "camera.wait_for_subscribers=2"}));
  EXPECT_THAT(arguments_of(plan, "segmentation"),
              IsSupersetOf(
                  {"segmentation.provider=dataset", "segmentation.dataset.folder=/data/sequence"}));
}

TEST(RunPlan, ModelReachesSegmentation) {
  const RunPlan plan = planned(options_of(SegmentationSource::kModel));
  EXPECT_THAT(
      arguments_of(plan, "segmentation"),
      IsSupersetOf({"segmentation.provider=model", "segmentation.model.file=/models/yolo.onnx"}));
}

TEST(RunPlan, LabelsReachSegmentationAndNeedAModel) {
  RunOptions options = options_of(SegmentationSource::kModel);
  EXPECT_THAT(arguments_of(planned(options), "segmentation"),
              Not(Contains(HasSubstr("segmentation.model.labels"))));
  options.labels = "/models/coco.txt";
  EXPECT_THAT(arguments_of(planned(options), "segmentation"),
              Contains("segmentation.model.labels=/models/coco.txt"));
  RunOptions without = options_of(SegmentationSource::kOff);
  without.labels = options.labels;
  const auto plan = make_run_plan(without, "/bin");
  ASSERT_FALSE(plan.has_value());
  EXPECT_EQ(plan.error().code, ExitCode::kUsage);
  EXPECT_THAT(plan.error().message, HasSubstr("--model FILE"));
}

TEST(RunPlan, ConfigurationAndOverridesReachEveryService) {
  RunOptions options = options_of(SegmentationSource::kDataset);
  options.config = "/etc/tsg.yaml";
  options.overrides = {"slam.max_features=800"};
  for (const ProcessPlan& process : planned(options).processes) {
    EXPECT_THAT(process.arguments,
                IsSupersetOf({"--config", "/etc/tsg.yaml", "--set", "slam.max_features=800"}))
        << process.service;
  }
}

TEST(RunPlan, NoConfigArgumentWithoutAConfigFile) {
  for (const ProcessPlan& process : planned(options_of(SegmentationSource::kOff)).processes) {
    EXPECT_THAT(process.arguments, Not(Contains("--config"))) << process.service;
  }
}

TEST(RunPlan, ModelWithoutFileIsAUsageError) {
  RunOptions options = options_of(SegmentationSource::kModel);
  options.model.clear();
  const auto plan = make_run_plan(options, "/bin");
  ASSERT_FALSE(plan.has_value());
  EXPECT_EQ(plan.error().code, ExitCode::kUsage);
  EXPECT_THAT(plan.error().message, HasSubstr("--model FILE"));
}

TEST(RunPlan, ModelFileThatNothingWouldReadIsAUsageError) {
  RunOptions options = options_of(SegmentationSource::kOff);
  options.model = "/models/yolo.onnx";
  const auto plan = make_run_plan(options, "/bin");
  ASSERT_FALSE(plan.has_value());
  EXPECT_EQ(plan.error().code, ExitCode::kUsage);
}

TEST(RunPlan, OverrideOfWhatAnOptionDecidesIsAUsageErrorNamingTheOption) {
  RunOptions options = options_of(SegmentationSource::kOff);
  options.overrides = {"camera.pace=realtime"};
  const auto plan = make_run_plan(options, "/bin");
  ASSERT_FALSE(plan.has_value());
  EXPECT_EQ(plan.error().code, ExitCode::kUsage);
  EXPECT_THAT(plan.error().message, HasSubstr("--pace"));
}

TEST(RunPlan, MapToStartInReachesSlamAlone) {
  RunOptions options = options_of(SegmentationSource::kOff);
  options.load_map = "/maps/home.tsgmap";
  options.localisation_only = true;
  const RunPlan plan = planned(options);
  EXPECT_THAT(arguments_of(plan, "slam"),
              IsSupersetOf({"slam.map.load=/maps/home.tsgmap", "slam.map.localisation_only=true"}));
  EXPECT_THAT(arguments_of(plan, "camera"), Not(Contains("slam.map.load=/maps/home.tsgmap")));
}

TEST(RunPlan, WithoutAMapSaysNothingOfMaps) {
  const RunPlan plan = planned(options_of(SegmentationSource::kOff));
  EXPECT_THAT(arguments_of(plan, "slam"), Not(Contains(HasSubstr("slam.map."))));
}

TEST(RunPlan, LocalisationOnlyNeedsAMap) {
  RunOptions options = options_of(SegmentationSource::kOff);
  options.localisation_only = true;
  const auto checked = check_run_options(options);
  ASSERT_FALSE(checked);
  EXPECT_EQ(checked.error().code, ExitCode::kUsage);
  EXPECT_THAT(checked.error().message, HasSubstr("--load-map FILE"));
}

}  // namespace
}  // namespace tsg
