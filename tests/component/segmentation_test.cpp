// tsg-segmentation as a process of its own, on a real bus.

#include <gtest/gtest.h>
#include <sched.h>
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <vector>

#include "tests/component/segmentation_service.hpp"
#include "tests/support/stop_limit.hpp"
#include "tests/support/temp_folder.hpp"
#include "tests/support/tiny_yolo_seg.hpp"

namespace tsg::test {
namespace {

using namespace std::chrono_literals;

/// Where the person (id 200) stands in the recorded mask of frame `seq`; the chair is id 7.
cv::Rect person_of(int seq) { return {30 + seq, 4, 10, 40}; }

/// A folder with the masks of frames 1 to 4, of which that of frame 3 is missing.
void write_dataset(const TempFolder& folder) {
  folder.write("instances.json", R"({"instances": {
    "7": {"cls": "chair", "name": "chair_0", "dynamic": false},
    "200": {"cls": "person", "name": "walker", "dynamic": true}}})");
  std::filesystem::create_directory(folder / "mask");
  for (const int seq : {1, 2, 4}) {
    cv::Mat mask(48, 64, CV_8UC1, cv::Scalar(0));
    mask(cv::Rect(2, 20, 10, 20)).setTo(7);
    mask(person_of(seq)).setTo(200);
    const std::string name = "mask/1700000000." + std::to_string(seq) + "00000.png";
    cv::imwrite(folder / name, mask);
  }
}

TEST_F(SegmentationService, AnswersEachFrameWithItsRecordedMaskThroughSharedMemory) {
  write_dataset(folder_);
  RunningSegmentation service(dataset(folder_));
  ASSERT_TRUE(is_working(service)) << service.output();
  for (const std::uint64_t seq : {1U, 2U, 4U}) {
    ASSERT_TRUE(send(seq));
    const auto mask = mask_of(seq);
    ASSERT_TRUE(mask.has_value()) << service.output();
    EXPECT_TRUE(mask->is_zero_copy());
    EXPECT_STREQ((*mask)->model_name, "dataset");
    EXPECT_GT((*mask)->inference_ns, 0);
    EXPECT_GT((*mask)->input_age_ns, 0);
    const auto found = view_as_instances(**mask);
    ASSERT_TRUE(found.has_value()) << found.error().message;
    EXPECT_EQ(found->stamp_ns, stamp_ns(seq));
    ASSERT_EQ(found->instances.size(), 2U);
    EXPECT_EQ(found->instances[0].class_name, "chair");
    EXPECT_EQ(found->instances[1].class_name, "person");
    EXPECT_EQ(found->instances[0].track_id, 7U) << "as in the sequence";
    EXPECT_EQ(found->instances[1].track_id, 200U);
    EXPECT_EQ(found->instances[1].motion, MotionVerdict::kUnknown);
    const cv::Rect person = person_of(static_cast<int>(seq));
    EXPECT_EQ(cv::countNonZero(found->labels == 2), person.area());
    EXPECT_EQ(cv::countNonZero(found->labels(person) == 2), person.area());
    EXPECT_EQ(cv::countNonZero(found->labels == 1), 10 * 20);
  }
}

TEST_F(SegmentationService, WithholdsAMaskThatIsMissingAndGoesOn) {
  write_dataset(folder_);
  RunningSegmentation service(dataset(folder_));
  ASSERT_TRUE(is_working(service)) << service.output();
  ASSERT_TRUE(send(3));
  ASSERT_TRUE(eventually(5s, [&] {
    return service.output().find("has no mask for stamp 1700000000.300000") != std::string::npos;
  })) << service.output();
  ASSERT_TRUE(send(4));
  const auto first = bus_.wait_for<topics::Instances>(10s, [](const auto&) { return true; });
  ASSERT_TRUE(first.has_value()) << service.output();
  EXPECT_EQ((*first)->header.seq, 4U);
}

TEST_F(SegmentationService, RejectsAFrameOfNoPossibleSizeAndGoesOn) {
  write_dataset(folder_);
  RunningSegmentation service(dataset(folder_));
  ASSERT_TRUE(is_working(service)) << service.output();
  ASSERT_TRUE(send(1, {kWidth, 0}));
  ASSERT_TRUE(eventually(5s, [&] {
    return service.output().find("mask withheld") != std::string::npos;
  })) << service.output();
  ASSERT_TRUE(send(2));
  EXPECT_TRUE(mask_of(2).has_value()) << service.output();
}

TEST_F(SegmentationService, WithFaultsPublishesLateMasksThatLackAnInstanceAndWarns) {
  write_dataset(folder_);
  std::vector<std::string> overrides = dataset(folder_);
  overrides.emplace_back("segmentation.faults.late_frames=2");
  overrides.emplace_back("segmentation.faults.drop_instance_every=1");
  RunningSegmentation service(overrides);
  ASSERT_TRUE(is_working(service)) << service.output();
  EXPECT_NE(service.output().find("faults=\"late_frames=2, drop_instance_every=1\""),
            std::string::npos)
      << service.output();
  ASSERT_TRUE(bus_.watch<topics::Diagnostics>());
  ASSERT_TRUE(send(1));
  const auto has_taken_it = [&] { return report().at("input_age_ms").at("p50") > 0.0; };
  ASSERT_TRUE(eventually(10s, has_taken_it)) << service.output();
  EXPECT_EQ(report().at("frames"), 0) << "it is held back";
  ASSERT_TRUE(send(4));
  const auto mask = mask_of(1);
  ASSERT_TRUE(mask.has_value()) << service.output();
  EXPECT_TRUE(mask->is_zero_copy());
  const auto seen = view_as_instances(**mask);
  ASSERT_TRUE(seen.has_value()) << seen.error().message;
  ASSERT_EQ(seen->instances.size(), 1U);
  EXPECT_EQ(seen->instances[0].class_name, "person");
  const cv::Rect person = person_of(1);
  EXPECT_EQ(cv::countNonZero(seen->labels(person) == 1), person.area());
  EXPECT_EQ(cv::countNonZero(seen->labels), person.area()) << "the chair is nobody's";
  EXPECT_EQ(report().at("frames"), 1) << "that of frame 4 is held back";
  EXPECT_EQ(report().at("faults"), "late_frames=2, drop_instance_every=1");
  EXPECT_TRUE(has_diagnostic([](const Diagnostic& diagnostic) {
    return diagnostic.level == DiagnosticLevel::kWarn &&
           diagnostic.message.find("on purpose") != std::string::npos &&
           value_of(diagnostic, "backlog") == "1";
  }));
}

TEST_F(SegmentationService, CountsAndReportsWhatItDid) {
  write_dataset(folder_);
  RunningSegmentation service(dataset(folder_));
  ASSERT_TRUE(is_working(service)) << service.output();
  ASSERT_TRUE(bus_.watch<topics::Diagnostics>());
  ASSERT_TRUE(send(3));  // withheld: there is no mask of it
  EXPECT_TRUE(has_diagnostic([](const Diagnostic& diagnostic) {
    return diagnostic.level == DiagnosticLevel::kWarn &&
           diagnostic.message.find("has no mask for stamp") != std::string::npos &&
           value_of(diagnostic, "failed") == "1";
  }));
  ASSERT_TRUE(send(4));
  ASSERT_TRUE(mask_of(4).has_value()) << service.output();
  const nlohmann::json reported = report();
  EXPECT_EQ(reported.at("frames"), 1);
  EXPECT_EQ(reported.at("failed"), 1);
  EXPECT_EQ(reported.at("passed_over"), 0);
  EXPECT_EQ(reported.at("backlog"), 0);
  EXPECT_EQ(reported.at("provider"), "dataset");
  EXPECT_GT(reported.at("inference_ms").at("p50"), 0.0);
  EXPECT_GT(reported.at("latency_ms").at("p99"), 0.0);
  EXPECT_GT(reported.at("input_age_ms").at("p50"), 0.0);
  EXPECT_TRUE(has_diagnostic([](const Diagnostic& diagnostic) {
    return diagnostic.level == DiagnosticLevel::kOk && value_of(diagnostic, "backlog") == "0" &&
           !value_of(diagnostic, "inference_p99_ms").empty();
  }));
}

TEST_F(SegmentationService, RunsANetworkOnFramesOfAnySize) {
  RunningSegmentation service(model(TinyYoloSeg{}.bytes()));
  ASSERT_TRUE(is_working(service)) << service.output();
  std::uint64_t seq = 0;
  for (const cv::Size size : {cv::Size(64, 32), cv::Size(640, 480)}) {
    ASSERT_TRUE(send(++seq, size));
    const auto mask = mask_of(seq);
    ASSERT_TRUE(mask.has_value()) << service.output();
    const auto found = view_as_instances(**mask);
    ASSERT_TRUE(found.has_value()) << found.error().message;
    EXPECT_STREQ((*mask)->model_name, "tiny.onnx");
    EXPECT_EQ(found->labels.size(), size);
    ASSERT_EQ(found->instances.size(), 1U);
    EXPECT_EQ(found->instances[0].class_name, "person");
    const int middle = size.height / 2;
    EXPECT_EQ(found->labels.at<std::uint8_t>(middle, size.width / 4), 1);
    EXPECT_EQ(found->labels.at<std::uint8_t>(middle, 3 * size.width / 4), 0);
  }
}

TEST_F(SegmentationService, AnswersTheNewestOfABurstAndPassesTheOthersOver) {
  RunningSegmentation service(model(TinyYoloSeg{.slow_layers = 200}.bytes()));
  ASSERT_TRUE(is_working(service)) << service.output();
  ASSERT_TRUE(send(1));
  ASSERT_TRUE(mask_of(1).has_value()) << service.output();
  constexpr std::uint64_t kFrames = 13;
  for (std::uint64_t seq = 2; seq <= kFrames; ++seq) ASSERT_TRUE(send(seq));
  ASSERT_TRUE(mask_of(kFrames).has_value()) << service.output();
  const nlohmann::json reported = report();
  const auto answered = reported.at("frames").get<std::uint64_t>();
  // The one before the burst, its last, and what a slow sender lets it have in between.
  EXPECT_LE(answered, kFrames / 2);
  EXPECT_EQ(answered + reported.at("passed_over").get<std::uint64_t>(), kFrames);
}

TEST_F(SegmentationService, StopsWithinTwoSecondsInTheMiddleOfANetwork) {
  RunningSegmentation service(model(TinyYoloSeg{.slow_layers = 6000}.bytes()));
  ASSERT_TRUE(is_working(service)) << service.output();
  ASSERT_TRUE(send(1));
  const auto early = bus_.wait_for<topics::Instances>(500ms, [](const auto&) { return true; });
  ASSERT_FALSE(early.has_value());  // the network is at work
  service.process().signal(SIGTERM);
  EXPECT_EQ(service.exit_code(kStopLimit), 0) << service.output();
}

TEST_F(SegmentationService, StopsWithinTwoSecondsWhileItWaitsForFrames) {
  RunningSegmentation service(model(TinyYoloSeg{}.bytes()));
  ASSERT_TRUE(is_working(service)) << service.output();
  service.process().signal(SIGTERM);
  EXPECT_EQ(service.exit_code(kStopLimit), 0) << service.output();
}

TEST_F(SegmentationService, WorksOnTheCpusThatItIsGiven) {
  cpu_set_t ours;
  ASSERT_EQ(::sched_getaffinity(0, sizeof(ours), &ours), 0);
  int cpu = 0;
  while (!CPU_ISSET(static_cast<std::size_t>(cpu), &ours)) ++cpu;
  std::vector<std::string> overrides = model(TinyYoloSeg{}.bytes());
  overrides.push_back("segmentation.cpus=" + std::to_string(cpu));
  RunningSegmentation service(overrides);
  ASSERT_TRUE(is_working(service)) << service.output();
  ASSERT_TRUE(send(1));
  ASSERT_TRUE(mask_of(1).has_value()) << service.output();
  cpu_set_t its;
  ASSERT_EQ(::sched_getaffinity(service.process().pid(), sizeof(its), &its), 0);
  EXPECT_EQ(CPU_COUNT(&its), 1);
  EXPECT_TRUE(CPU_ISSET(static_cast<std::size_t>(cpu), &its));
}

TEST_F(SegmentationService, WorksAtALowerPriorityThanTracking) {
  write_dataset(folder_);
  std::vector<std::string> overrides = dataset(folder_);
  overrides.emplace_back("segmentation.nice=7");
  RunningSegmentation service(overrides);
  ASSERT_TRUE(is_working(service)) << service.output();
  ASSERT_TRUE(send(1));
  ASSERT_TRUE(mask_of(1).has_value()) << service.output();
  EXPECT_EQ(::getpriority(PRIO_PROCESS, static_cast<id_t>(service.process().pid())), 7);
}

}  // namespace
}  // namespace tsg::test
