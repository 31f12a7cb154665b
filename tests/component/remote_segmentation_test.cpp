// tsg-segmentation that has frames segmented by another one over the network, as two processes on
// one host. tests/component/remote_link_test.cpp has two hosts and a bad link.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <string>
#include <vector>

#include "tests/component/segmentation_service.hpp"
#include "tests/support/stop_limit.hpp"
#include "tests/support/tiny_yolo_seg.hpp"

namespace tsg::test {
namespace {

class RemoteSegmentation : public SegmentationService {
 protected:
  /// Settings of the one that has none of shared memory, and a network.
  std::vector<std::string> worker(const TinyYoloSeg& network = {}) {
    std::vector<std::string> overrides = model(network.bytes());
    overrides.emplace_back("segmentation.input=network");
    overrides.emplace_back("bus.use_shared_memory=false");
    return overrides;
  }
  static std::vector<std::string> relay() {
    return {"segmentation.provider=remote", "segmentation.remote.patience_ms=500"};
  }

  /// Sends frames until one comes back with its mask; the first of these masks.
  std::optional<Sample<topics::Instances>> first_mask(std::uint64_t seq) {
    const auto deadline = std::chrono::steady_clock::now() + 20s;
    while (std::chrono::steady_clock::now() < deadline) {
      if (!send(seq)) return std::nullopt;
      auto mask = bus_.wait_for<topics::Instances>(
          200ms, [&](const tsg_InstanceMask& message) { return message.header.seq == seq; });
      if (mask) return mask;
      ++seq;
    }
    return std::nullopt;
  }

  [[nodiscard]] bool has_link(const std::string& state) {
    return has_diagnostic(
        [&](const Diagnostic& diagnostic) { return value_of(diagnostic, "link") == state; });
  }
};

TEST_F(RemoteSegmentation, GivesMasksThroughSharedMemoryAsIfTheyWereMadeHere) {
  RunningSegmentation far(worker());
  RunningSegmentation near(relay());
  ASSERT_TRUE(is_working(near)) << near.output();
  const auto mask = first_mask(1);
  ASSERT_TRUE(mask.has_value()) << near.output() << far.output();
  EXPECT_TRUE(mask->is_zero_copy());
  EXPECT_STREQ((*mask)->model_name, "tiny.onnx");
  EXPECT_GT((*mask)->inference_ns, 0);
  EXPECT_GT((*mask)->input_age_ns, 0);
  const auto found = view_as_instances(**mask);
  ASSERT_TRUE(found.has_value()) << found.error().message;
  EXPECT_EQ(found->stamp_ns, stamp_ns(found->frame_seq));
  EXPECT_EQ(found->labels.size(), cv::Size(kWidth, kHeight));
  ASSERT_EQ(found->instances.size(), 1U);
  EXPECT_EQ(found->instances[0].class_name, "person");
  EXPECT_NE(found->instances[0].track_id, 0U);
  EXPECT_EQ(found->labels.at<std::uint8_t>(kHeight / 2, kWidth / 4), 1);
  EXPECT_EQ(found->labels.at<std::uint8_t>(kHeight / 2, 3 * kWidth / 4), 0);
  const nlohmann::json reported = report();
  EXPECT_EQ(reported.at("link"), "up");
  EXPECT_EQ(reported.at("provider"), "tiny.onnx");
  EXPECT_GT(reported.at("latency_ms").at("p50"), 0.0);
}

TEST_F(RemoteSegmentation, SaysThatNobodyIsThereAndGivesMasksOnceSomebodyIs) {
  RunningSegmentation near(relay());
  ASSERT_TRUE(is_working(near)) << near.output();
  ASSERT_TRUE(bus_.watch<topics::Diagnostics>());
  ASSERT_TRUE(send(1));
  EXPECT_TRUE(says(near, "no other host offers segmentation")) << near.output();
  EXPECT_TRUE(has_link("nobody there"));
  {
    RunningSegmentation far(worker());
    ASSERT_TRUE(first_mask(2).has_value()) << near.output() << far.output();
    EXPECT_TRUE(has_link("up"));
  }
  EXPECT_TRUE(has_link("nobody there")) << "it has gone";
  RunningSegmentation again(worker());
  EXPECT_TRUE(first_mask(1000).has_value()) << near.output() << again.output();
}

TEST_F(RemoteSegmentation, NeverHasMoreFramesUnderWayThanAllowed) {
  RunningSegmentation far(worker({.slow_layers = 100}));
  std::vector<std::string> overrides = relay();
  overrides.emplace_back("segmentation.remote.patience_ms=10000");
  RunningSegmentation near(overrides);
  ASSERT_TRUE(is_working(near)) << near.output();
  ASSERT_TRUE(first_mask(1).has_value()) << near.output() << far.output();
  constexpr std::uint64_t kFrames = 40;
  for (std::uint64_t i = 0; i < kFrames; ++i) {
    ASSERT_TRUE(send(10'000 + i));
    if (i % 10 == 5) {
      EXPECT_LE(report().at("backlog"), 2);
    }
  }
  const nlohmann::json reported = report();
  EXPECT_LT(reported.at("taken"), kFrames) << "the others were passed over";
  EXPECT_GT(reported.at("passed_over"), 0);
}

TEST_F(RemoteSegmentation, SaysWhereTheOtherHostDoesNotAnswer) {
  RunningSegmentation far(worker());
  RunningSegmentation near(relay());
  ASSERT_TRUE(is_working(near)) << near.output();
  ASSERT_TRUE(bus_.watch<topics::Diagnostics>());
  ASSERT_TRUE(first_mask(1).has_value()) << near.output() << far.output();
  far.process().signal(SIGSTOP);  // there, for some time, but as if asleep
  std::uint64_t seq = 1000;
  const bool is_told = eventually(10s, [&] {
    return send(++seq) && (near.output().find("does not answer") != std::string::npos ||
                           near.output().find("no other host") != std::string::npos);
  });
  EXPECT_TRUE(is_told) << near.output();
  far.process().signal(SIGCONT);
  EXPECT_TRUE(first_mask(100'000).has_value()) << near.output() << far.output();
}

TEST_F(RemoteSegmentation, StopsBothWithinTwoSeconds) {
  RunningSegmentation far(worker({.slow_layers = 6000}));
  RunningSegmentation near(relay());
  ASSERT_TRUE(is_working(near)) << near.output();
  ASSERT_TRUE(bus_.watch<topics::RemoteColour>(10s));
  const bool is_sent = eventually(10s, [&] {
    return send(1) && bus_.subscriber<topics::RemoteColour>().try_take().has_value();
  });
  ASSERT_TRUE(is_sent) << near.output();  // the network is at work
  near.process().signal(SIGTERM);
  EXPECT_EQ(near.exit_code(kStopLimit), 0) << near.output();
  far.process().signal(SIGTERM);
  EXPECT_EQ(far.exit_code(kStopLimit), 0) << far.output();
}

TEST_F(RemoteSegmentation, TakesNoMaskThatIsNotOneOfItsFrames) {
  RunningSegmentation near(relay());
  ASSERT_TRUE(is_working(near)) << near.output();
  ASSERT_TRUE(bus_.watch<topics::RemoteColour>(10s));
  ASSERT_TRUE(eventually(10s, [&] { return send(7) && report().at("taken") > 0; }))
      << near.output();
  const auto frame = bus_.subscriber<topics::RemoteColour>().take({}, 5s);
  ASSERT_TRUE(frame.has_value());
  const std::vector<std::uint8_t> nonsense{1, 2, 3};
  const auto answer = [&](std::int64_t later_ns, std::uint32_t wider) {
    return bus_.publish<topics::RemoteMask>([&](tsg_CompressedMask& message) {
      message.header = (*frame)->header;
      message.header.publish_monotonic_ns += later_ns;
      message.width = (*frame)->width + wider;
      message.height = (*frame)->height;
      lend(nonsense, message.labels);
    });
  };
  ASSERT_TRUE(answer(1, 0));  // of another robot: passed over
  ASSERT_TRUE(answer(0, 1));
  EXPECT_TRUE(says(near, "not of its frame's size")) << near.output();
  EXPECT_EQ(report().at("failed"), 1);
  EXPECT_EQ(report().at("frames"), 0);
  EXPECT_FALSE(bus_.subscriber<topics::Instances>().try_take().has_value());
}

TEST_F(RemoteSegmentation, AnswersFramesOnlyThatShowWhatTheySay) {
  RunningSegmentation far(worker());
  ASSERT_TRUE(bus_.watch<topics::RemoteMask>(20s)) << far.output();
  const std::vector<std::uint8_t> nonsense{1, 2, 3};
  int sent = 0;
  for (const std::uint32_t width : {0U, 64U, 4'000'000U}) {
    ASSERT_TRUE(bus_.publish<topics::RemoteColour>([&](tsg_CompressedColour& message) {
      message.header = {width, 1, 1};
      message.width = width;
      message.height = 48;
      lend(nonsense, message.jpeg);
    }));
    ++sent;
    EXPECT_TRUE(eventually(5s, [&] { return report("remote_segmentation").at("failed") == sent; }))
        << far.output();
  }
  EXPECT_FALSE(bus_.subscriber<topics::RemoteMask>().try_take().has_value());
}

}  // namespace
}  // namespace tsg::test
