#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <thread>
#include <vector>

#include "common/bus/command.hpp"
#include "common/bus/convert.hpp"
#include "common/bus/diagnostics.hpp"
#include "common/core/time.hpp"
#include "tests/component/camera_process.hpp"
#include "tests/support/stop_limit.hpp"
#include "tests/support/synthetic_sequence.hpp"
#include "tests/support/test_bus.hpp"

namespace tsg::test {
namespace {

using namespace std::chrono_literals;
using ::testing::HasSubstr;

/// A camera with a made-up sequence, and the other side of its topics.
class Camera : public ::testing::Test {
 protected:
  void write_sequence(int frames) {
    sequence_.frames = frames;
    sequence_.write_to(folder_);
    (void)bus_.subscriber<topics::Rgbd>();  // is there before the camera looks for it
  }

  std::optional<Sample<topics::Rgbd>> take(std::chrono::milliseconds timeout = 10s) {
    return bus_.subscriber<topics::Rgbd>().take({}, timeout);
  }

  /// What slam says once it is done with a frame.
  void answer(std::uint64_t seq) {
    tsg_TrackingStatus status{};
    status.header.seq = seq;
    ASSERT_TRUE(bus_.publisher<topics::TrackingStatus>().publish(status));
  }

  nlohmann::json report() {
    CommandClient client(bus_.bus());
    const auto reply = client.call("camera", "report", "{}", 5s);
    EXPECT_TRUE(reply) << reply.error().message;
    return reply ? nlohmann::json::parse(*reply) : nlohmann::json::object();
  }

  /// How many frames the camera is done with, sent or not.
  int frames_done() {
    const auto figures = report();
    return figures.value("frames_sent", 0) + figures.value("frames_late", 0) +
           figures.value("frames_dropped_pool", 0);
  }

  /// Takes frames until the camera is done with `total`: however slow the machine, none is missed.
  template <typename Visit>
  void take_all(int total, const Visit& visit) {
    const auto deadline = std::chrono::steady_clock::now() + 60s;
    while (frames_done() < total && std::chrono::steady_clock::now() < deadline) {
      while (const auto sample = take(100ms)) visit(*sample);
    }
    while (const auto sample = take(100ms)) visit(*sample);
  }

  void expect_frame(const Sample<topics::Rgbd>& sample, int index) {
    const auto frame = view_as_frame(*sample);
    ASSERT_TRUE(frame) << frame.error().message;
    EXPECT_EQ(frame->seq, static_cast<std::uint64_t>(index));
    EXPECT_EQ(frame->stamp_ns, sequence_.stamp_ns(index));
    EXPECT_DOUBLE_EQ(frame->camera.fy, 51.0);
    EXPECT_DOUBLE_EQ(frame->camera.distortion[4], 0.5);
    EXPECT_DOUBLE_EQ(frame->depth_units_per_metre, 5000.0);
    EXPECT_TRUE(is_same_image(frame->colour, sequence_.colour(index)));
    EXPECT_TRUE(is_same_image(frame->depth, sequence_.depth(index)));
    EXPECT_TRUE(sample.is_zero_copy());
  }

  TestBus bus_;
  TempFolder folder_;
  SyntheticSequence sequence_;
};

TEST_F(Camera, LockstepSendsEveryFrameIntactAndOnlyOnceTheLastIsAnswered) {
  write_sequence(12);
  (void)bus_.publisher<topics::TrackingStatus>();
  CameraProcess camera(folder_.path(), {"camera.pace=lockstep"});
  for (int i = 0; i < 12; ++i) {
    const auto sample = take();
    ASSERT_TRUE(sample) << camera.log();
    expect_frame(*sample, i);
    if (i < 2) {
      EXPECT_FALSE(take(150ms)) << "a frame came before the last was answered";
    }
    answer(static_cast<std::uint64_t>(i));
  }
  EXPECT_EQ(camera.exit_code(), 0) << camera.log();
  EXPECT_FALSE(take(10ms));
}

TEST_F(Camera, RealtimeSendsByTheStampsNeverEarlyAndNeverMoreThanAPeriodLate) {
  write_sequence(45);
  CameraProcess camera(folder_.path(), {"camera.drain_s=3"});
  std::int64_t first_sent_ns = 0;
  std::uint64_t received = 0;
  std::uint64_t last_seq = 0;
  while (const auto sample = take(received == 0 ? 10s : 1s)) {
    const auto& header = (*sample)->header;
    if (received++ == 0) {
      const auto periods = static_cast<std::int64_t>(header.seq);
      first_sent_ns = header.publish_monotonic_ns - periods * 33'333'000;
    }
    const auto behind_ns =
        header.publish_monotonic_ns - first_sent_ns - (header.stamp_ns - kSequenceStartNs);
    EXPECT_GT(behind_ns, -2'000'000) << "frame " << header.seq;
    EXPECT_LT(behind_ns, 60'000'000) << "frame " << header.seq;
    last_seq = header.seq;
  }
  const auto figures = report();
  EXPECT_EQ(figures["frames_sent"], received);
  EXPECT_EQ(figures["frames_sent"].get<int>() + figures["frames_late"].get<int>(), 45);
  EXPECT_GE(received, 35U) << "a small sequence must hold 30 Hz even on a busy machine";
  EXPECT_LE(last_seq, 44U);
  EXPECT_EQ(camera.exit_code(), 0) << camera.log();
}

TEST_F(Camera, FramesThatAStallMadeLateAreDroppedAndCounted) {
  write_sequence(45);
  CameraProcess camera(folder_.path(), {"camera.drain_s=3"});
  for (int i = 0; i < 5; ++i) ASSERT_TRUE(take()) << camera.log();
  camera.child().signal(SIGSTOP);
  std::this_thread::sleep_for(500ms);  // the stall itself
  camera.child().signal(SIGCONT);
  while (take(1s)) {
  }
  const auto figures = report();
  const int late = figures["frames_late"];
  EXPECT_GE(late, 10);
  EXPECT_EQ(figures["frames_sent"].get<int>() + late, 45);
  EXPECT_EQ(bus_.subscriber<topics::Rgbd>().missed(), static_cast<std::uint64_t>(late));
}

TEST_F(Camera, FramesWithoutFreeMemoryAreDroppedAndCountedUntilThereIsSomeAgain) {
  write_sequence(75);
  CameraProcess camera(folder_.path(), {"camera.drain_s=6"});
  std::vector<Sample<topics::Rgbd>> kept;
  const auto dropped = [&] { return report().value("frames_dropped_pool", 0); };
  kept.push_back(take().value());
  // On a busy machine other frames are late; only those that find no memory count here.
  while (dropped() < 5 && frames_done() < 75) {
    if (auto sample = take(50ms)) kept.push_back(std::move(*sample));
  }
  ASSERT_GE(dropped(), 5);
  ASSERT_GT(kept.size(), 10U);
  ASSERT_LT(kept.size(), 40U) << "the pool is larger than this test thinks";
  kept.clear();
  int received = 0;
  take_all(75, [&](const auto&) { ++received; });
  EXPECT_GT(received, 0) << "frames must flow again";
  EXPECT_EQ(frames_done(), 75);
  EXPECT_EQ(camera.exit_code(), 0) << camera.log();
}

TEST_F(Camera, SimulationIsLiveWithStampsOfThePresentAtTheRateOfTheScene) {
#ifdef __SANITIZE_THREAD__
  GTEST_SKIP() << "Embree and TBB, which render, are not built with the thread sanitizer";
#endif
  const auto scene = folder_.write("room.yaml", R"(duration_s: 5
rooms: [{min_m: [0, 0], max_m: [4, 3]}]
camera: {waypoints: [{at_s: 0, position_m: [0.5, 1.5, 1.4], look_at_m: [3, 1.5, 1.2]}]}
)");
  (void)bus_.subscriber<topics::Rgbd>();
  const std::int64_t before_ns = utc_ns();
  CameraProcess camera(folder_.path(),
                       {"camera.source=simulation", "camera.simulation.scene=" + scene.string(),
                        "camera.simulation.width=160", "camera.simulation.height=120",
                        "camera.simulation.rate_hz=2", "camera.drain_s=6"});
  std::int64_t first_stamp_ns = 0;
  int received = 0;
  const auto check = [&](const Sample<topics::Rgbd>& sample) {
    const auto frame = view_as_frame(*sample);
    ASSERT_TRUE(frame) << frame.error().message;
    EXPECT_EQ(frame->camera.width, 160);
    if (received++ == 0) first_stamp_ns = frame->stamp_ns;
    EXPECT_EQ(frame->stamp_ns - first_stamp_ns,
              static_cast<std::int64_t>(frame->seq) * 500'000'000);
    EXPECT_GT(cv::countNonZero(frame->depth), 160 * 120 / 2);
  };
  const auto first = take(60s);  // it builds the scene first
  ASSERT_TRUE(first) << camera.log();
  check(*first);
  take_all(10, check);
  EXPECT_GT(first_stamp_ns, before_ns);
  EXPECT_LT(first_stamp_ns, utc_ns());
  // How many it manages depends on the machine, which may be busy.
  EXPECT_GE(received, 2);
  EXPECT_EQ(report()["frames_sent"], received);
  EXPECT_EQ(frames_done(), 10);
  EXPECT_EQ(camera.exit_code(), 0) << camera.log();
}

TEST_F(Camera, TruncatedImageStopsItWithTheFileNamedAfterTheFramesBefore) {
  write_sequence(10);
  const auto image = folder_ / "depth" / (sequence_.stamp_text(6) + ".png");
  folder_.write(image, content_of(image).substr(0, 500));
  (void)bus_.publisher<topics::TrackingStatus>();
  // In lockstep no frame is late, however busy the machine.
  CameraProcess camera(folder_.path(), {"camera.pace=lockstep"});
  for (int i = 0; i < 6; ++i) {
    const auto sample = take();
    ASSERT_TRUE(sample) << camera.log();
    expect_frame(*sample, i);
    answer(static_cast<std::uint64_t>(i));
  }
  EXPECT_EQ(camera.exit_code(), 65);
  EXPECT_THAT(camera.log(), HasSubstr(image.string() + " is truncated"));
}

TEST_F(Camera, DepthOfAnotherSizeStopsItWithBothFilesNamed) {
  write_sequence(3);
  const std::string name = sequence_.stamp_text(0) + ".png";
  cv::imwrite((folder_ / "depth" / name).string(), cv::Mat(24, 32, CV_16UC1, cv::Scalar(1)));
  CameraProcess camera(folder_.path(), {});
  EXPECT_EQ(camera.exit_code(), 68);
  EXPECT_THAT(camera.log(), HasSubstr((folder_ / "rgb" / name).string() + " is 64x48"));
  EXPECT_THAT(camera.log(), HasSubstr((folder_ / "depth" / name).string() + " is 32x24"));
}

TEST_F(Camera, SlamThatDoesNotAnswerIsATimeoutThatNamesIt) {
  write_sequence(3);
  (void)bus_.publisher<topics::TrackingStatus>();
  CameraProcess camera(folder_.path(), {"camera.pace=lockstep", "camera.lockstep_timeout_s=0.5"});
  EXPECT_EQ(camera.exit_code(), 75);
  EXPECT_THAT(camera.log(), HasSubstr("slam has not answered frame 0 within 0.5 s"));
}

TEST_F(Camera, SubscribersThatDoNotComeAreATimeout) {
  write_sequence(3);
  CameraProcess camera(folder_.path(),
                       {"camera.wait_for_subscribers=2", "camera.subscriber_timeout_s=0.5"});
  EXPECT_EQ(camera.exit_code(), 75);
  EXPECT_THAT(camera.log(), HasSubstr("2 subscribers of tsg/rgbd did not come within 0.5 s"));
}

TEST_F(Camera, ImagesLargerThanTheBusCarriesAreASizeMismatch) {
  write_sequence(1);
  folder_.write("camera.yaml", SyntheticSequence{.size = {1920, 1080}}.camera_yaml());
  CameraProcess camera(folder_.path(), {});
  EXPECT_EQ(camera.exit_code(), 68);
  EXPECT_THAT(camera.log(), HasSubstr("1920x1080"));
}

TEST_F(Camera, SigtermEndsItWithinTwoSecondsWhateverItDoes) {
  write_sequence(3);
  CameraProcess sending(folder_.path(), {"camera.replay.loop=true"});
  ASSERT_TRUE(take()) << sending.log();
  sending.child().signal(SIGTERM);
  EXPECT_EQ(sending.exit_code(kStopLimit), 0) << sending.log();

  CameraProcess waiting(folder_.path(), {"camera.wait_for_subscribers=5"});
  ASSERT_TRUE(bus_.watch<topics::Diagnostics>(10s)) << waiting.log();
  waiting.child().signal(SIGTERM);
  EXPECT_EQ(waiting.exit_code(kStopLimit), 0) << waiting.log();
}

TEST_F(Camera, SaysOnceASecondHowItIs) {
  write_sequence(3);
  CameraProcess camera(folder_.path(), {"camera.replay.loop=true"});
  ASSERT_TRUE(bus_.watch<topics::Diagnostics>(10s)) << camera.log();
  ASSERT_TRUE(bus_.wait_for<topics::Diagnostics>(5s, [](const auto& message) {
    const auto status = to_diagnostics(message);
    if (status.size() != 1 || status[0].name.find("camera") == std::string::npos) return false;
    return std::ranges::any_of(status[0].diagnostic.values, [](const auto& entry) {
      return entry.first == "rate_hz" && std::stod(entry.second) > 15.0;
    });
  })) << camera.log();
}

}  // namespace
}  // namespace tsg::test
