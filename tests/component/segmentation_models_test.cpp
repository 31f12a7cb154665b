// tsg-segmentation with networks of every layout, and with bad ones, as a process on a real bus.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <opencv2/core.hpp>
#include <random>
#include <string>
#include <vector>

#include "tests/component/segmentation_service.hpp"
#include "tests/support/made_networks.hpp"
#include "tests/support/tiny_yolo_seg.hpp"

namespace tsg::test {
namespace {

constexpr std::uint8_t kWhite = 255;

const std::vector<MadeObject> kLeftAndRight{
    {.class_id = 1, .centre = {0.25F, 0.5F}, .radii = {0.15F, 0.4F}},
    {.class_id = 0, .score = 0.8F, .centre = {0.75F, 0.5F}, .radii = {0.15F, 0.4F}}};

MadeNetwork solov2(bool is_merged) {
  std::mt19937 random(1);
  const MadeSolov2 made{
      .input_size = {64, 48},
      .grids = is_merged ? std::array{40, 36, 24, 16, 12} : std::array{12, 10, 8, 6, 4},
      .classes = 2,
      .kernel_length = 3,
      .is_merged = is_merged,
      .noise = 0.0F};
  return made.network(kLeftAndRight, random);
}

class SegmentationModels : public SegmentationService {
 protected:
  /// Expects two frames to be answered with the two objects, under the same ids.
  void expect_both_found(const MadeNetwork& network) {
    const std::string labels = folder_.write("two.txt", "chair\nperson\n");
    std::vector<std::string> overrides = model(network.onnx(/*has_names=*/false));
    overrides.push_back("segmentation.model.labels=" + labels);
    RunningSegmentation service(overrides);
    ASSERT_TRUE(is_working(service)) << service.output();
    std::vector<std::uint32_t> ids;
    for (const std::uint64_t seq : {1U, 2U}) {
      ASSERT_TRUE(send(seq));
      const auto mask = mask_of(seq);
      ASSERT_TRUE(mask.has_value()) << service.output();
      EXPECT_TRUE(mask->is_zero_copy());
      const auto found = view_as_instances(**mask);
      ASSERT_TRUE(found.has_value()) << found.error().message;
      ASSERT_EQ(found->instances.size(), 2U);
      EXPECT_EQ(found->instances[0].class_name, "person");
      EXPECT_EQ(found->instances[1].class_name, "chair");
      EXPECT_EQ(found->labels.at<std::uint8_t>(kHeight / 2, kWidth / 4), 1);
      EXPECT_EQ(found->labels.at<std::uint8_t>(kHeight / 2, 3 * kWidth / 4), 2);
      EXPECT_EQ(found->labels.at<std::uint8_t>(kHeight / 2, kWidth / 2), 0);
      for (const Instance& instance : found->instances) ids.push_back(instance.track_id);
    }
    EXPECT_EQ(ids[0], ids[2]);
    EXPECT_EQ(ids[1], ids[3]);
    EXPECT_NE(ids[0], ids[1]);
  }

  /// Expects the masks of white frames to be withheld, saying `why`, and no others.
  void expect_withheld_in_white(InWhite flaw, const std::string& why) {
    RunningSegmentation service(model(TinyYoloSeg{.in_white = flaw}.bytes()));
    ASSERT_TRUE(is_working(service)) << service.output();
    ASSERT_TRUE(bus_.watch<topics::Diagnostics>());
    ASSERT_TRUE(send(1));
    ASSERT_TRUE(mask_of(1).has_value()) << service.output();
    ASSERT_TRUE(send(2, {kWidth, kHeight}, kWhite));
    ASSERT_TRUE(says(service, why)) << service.output();
    EXPECT_TRUE(has_diagnostic([&](const Diagnostic& diagnostic) {
      return diagnostic.level == DiagnosticLevel::kWarn &&
             diagnostic.message.find(why) != std::string::npos;
    }));
    ASSERT_TRUE(send(3));
    const auto next = bus_.wait_for<topics::Instances>(10s, [](const auto&) { return true; });
    ASSERT_TRUE(next.has_value()) << service.output();
    EXPECT_EQ((*next)->header.seq, 3U);
    EXPECT_EQ((*next)->instance_count, 1U);
    const nlohmann::json reported = report();
    EXPECT_EQ(reported.at("failed"), 1);
    EXPECT_EQ(reported.at("frames"), 2);
  }
};

TEST_F(SegmentationModels, FindWithRawSolov2) { expect_both_found(solov2(/*is_merged=*/false)); }

TEST_F(SegmentationModels, FindWithMergedSolov2) { expect_both_found(solov2(/*is_merged=*/true)); }

TEST_F(SegmentationModels, FindWithRtmdet) {
  expect_both_found(made_rtmdet({64, 48}, 2, kLeftAndRight, MadeMasks::kProbabilities));
}

TEST_F(SegmentationModels, WithholdAMaskWhereTheNetworkGivesNaNAndGoOn) {
  expect_withheld_in_white(InWhite::kGivesNan, "the network's outputs hold NaN");
}

TEST_F(SegmentationModels, WithholdAMaskWhereTheNetworkFailsAndGoOn) {
  expect_withheld_in_white(InWhite::kFails, "the network failed: ");
}

TEST_F(SegmentationModels, GoOnWhenTheirFileIsReplacedAndSayThatItTakesARestart) {
  RunningSegmentation service(model(TinyYoloSeg{}.bytes()));
  ASSERT_TRUE(is_working(service)) << service.output();
  ASSERT_TRUE(bus_.watch<topics::Diagnostics>());
  const std::string said = "tiny.onnx was replaced";
  folder_.write("tiny.onnx", "not even a network");  // in place, as a careless copy does
  ASSERT_TRUE(says(service, said)) << service.output();
  EXPECT_TRUE(has_diagnostic([&](const Diagnostic& diagnostic) {
    return diagnostic.level == DiagnosticLevel::kWarn &&
           diagnostic.message.find(said) != std::string::npos;
  }));
  ASSERT_TRUE(send(1));
  ASSERT_TRUE(mask_of(1).has_value()) << service.output();
}

TEST_F(SegmentationModels, RunOnTheCpuWhereThereIsNoGpuAndSaySo) {
  if (std::filesystem::exists("/dev/nvidiactl")) GTEST_SKIP() << "this machine has an NVIDIA GPU";
  std::vector<std::string> overrides = model(TinyYoloSeg{}.bytes());
  overrides.emplace_back("segmentation.model.provider=cuda");
  RunningSegmentation service(overrides);
  ASSERT_TRUE(is_working(service)) << service.output();
  ASSERT_TRUE(bus_.watch<topics::Diagnostics>());
  const std::string said = "the network does not run on cuda";
  EXPECT_TRUE(says(service, said)) << service.output();
  EXPECT_TRUE(has_diagnostic([&](const Diagnostic& diagnostic) {
    return diagnostic.message.find(said) != std::string::npos &&
           value_of(diagnostic, "runs_on") == "cpu";
  }));
  ASSERT_TRUE(send(1));
  ASSERT_TRUE(mask_of(1).has_value()) << service.output();
}

}  // namespace
}  // namespace tsg::test
