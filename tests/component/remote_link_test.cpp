// Tracking on one host, segmentation on another, and a link between them that is slow, loses
// packets, goes away and comes back: real processes in two network namespaces.

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "common/bus/convert.hpp"
#include "common/core/time.hpp"
#include "tests/support/running_segmentation.hpp"
#include "tests/support/test_bus.hpp"
#include "tests/support/textured_wall.hpp"
#include "tests/support/tiny_yolo_seg.hpp"
#include "tests/support/two_hosts.hpp"

namespace tsg::test {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kPeriod{100};  // of frames: both cores are shared with others

class RemoteLink : public ::testing::Test {
 protected:
  void SetUp() override {
    hosts_ = std::make_unique<TwoHosts>();
    if (!hosts_->is_there()) GTEST_SKIP() << hosts_->why_not();
    bus_ = std::make_unique<TestBus>(BusConfig{.interface = "robot0"});
    start_processes();
    auto& frames = bus_->publisher<topics::Rgbd>();
    ASSERT_TRUE(frames.wait_for_subscribers(2, 20s)) << slam_->output() << near_->output();
    ASSERT_TRUE(bus_->watch<topics::TrackingStatus>(20s)) << slam_->output();
    ASSERT_TRUE(bus_->watch<topics::Instances>(20s)) << near_->output();
  }

  void start_processes() {
    const std::string network = folder_.write("tiny.onnx", TinyYoloSeg{}.bytes());
    far_.emplace("nsenter",
                 hosts_->on_other_host(
                     TSG_BIN_DIR "/tsg-segmentation",
                     {"--set", "bus.interface=base0", "--set", "bus.use_shared_memory=false",
                      "--set", "segmentation.input=network", "--set", "segmentation.provider=model",
                      "--set", "segmentation.model.file=" + network}));
    near_.emplace(std::vector<std::string>{"bus.interface=robot0", "segmentation.provider=remote"});
    slam_.emplace(TSG_BIN_DIR "/tsg-slam",
                  std::vector<std::string>{"--set", "bus.interface=robot0"});
  }

  void TearDown() override {
    // Before RouDi, and without being killed: who is while it reads leaves iceoryx's locks taken.
    if (slam_) slam_->child().terminate(5s);
    near_.reset();
  }

  /// What came of frames that were sent for some time.
  struct Period {
    int frames = 0;
    int tracked = 0;
    int lost = 0;
    int masks = 0;
    Clock::duration longest_silence{};  ///< of tracking
    std::optional<Clock::duration> until_mask;
  };

  /// Sends frames for `duration`, or until a mask comes.
  Period run(Clock::duration duration, bool until_mask = false) {
    Period period;
    const auto start = Clock::now();
    auto heard = start;
    for (auto next = start; next < start + duration; next += kPeriod) {
      std::this_thread::sleep_until(next);
      send_frame();
      ++period.frames;
      take_answers(period, heard);
      const auto& masks = bus_->subscriber<topics::Instances>().try_take();
      if (masks) {
        ++period.masks;
        if (!period.until_mask) period.until_mask = Clock::now() - start;
        if (until_mask) break;
      }
    }
    return period;
  }

  void send_frame() {
    const double x_m = 0.2 * std::sin(0.05 * static_cast<double>(seq_));
    RgbdFrame frame = wall_.frame(seq_, x_m, 0.0);
    auto loan = bus_->publisher<topics::Rgbd>().loan();
    ASSERT_TRUE(loan) << loan.error().message;
    ASSERT_TRUE(fill_message(frame, **loan));
    ASSERT_TRUE(bus_->publisher<topics::Rgbd>().publish(std::move(*loan)));
    ++seq_;
  }

  void take_answers(Period& period, Clock::time_point& heard) {
    period.longest_silence = std::max(period.longest_silence, Clock::now() - heard);
    while (const auto status = bus_->subscriber<topics::TrackingStatus>().try_take()) {
      (*status)->state == tsg_TRACKING_OK ? ++period.tracked : ++period.lost;
      heard = Clock::now();
    }
  }

  void expect_tracking(const Period& period, const std::string& when) {
    SCOPED_TRACE(when);
    RecordProperty(when + "_tracked", period.tracked);
    RecordProperty(when + "_masks", period.masks);
    std::cout << when << ": " << period.frames << " frames, " << period.tracked << " tracked, "
              << period.masks << " masks, longest silence "
              << std::chrono::duration<double>(period.longest_silence).count() << " s, first mask "
              << (period.until_mask ? std::chrono::duration<double>(*period.until_mask).count()
                                    : -1)
              << " s\n";
    EXPECT_EQ(period.lost, 0);
    EXPECT_GE(period.tracked, period.frames * 8 / 10);
    EXPECT_LT(period.longest_silence, 1s);
  }

  TempFolder folder_;
  std::unique_ptr<TwoHosts> hosts_;
  std::unique_ptr<TestBus> bus_;
  TexturedWall wall_;
  std::uint64_t seq_ = 0;
  std::optional<RunningProgram> far_;
  std::optional<RunningSegmentation> near_;
  std::optional<RunningProgram> slam_;
};

TEST_F(RemoteLink, NeverStopsTrackingAndBringsMasksBackWhateverItDoes) {
  const Period first = run(20s, /*until_mask=*/true);
  ASSERT_TRUE(first.until_mask) << near_->output() << far_->output();
  run(2s);  // all have found each other; the map has its first keyframes

  hosts_->set_link(50, 0.05);
  const Period bad = run(8s);
  expect_tracking(bad, "50 ms and 5 % lost");
  EXPECT_GE(bad.masks, 8) << "one a second at least";

  hosts_->cut_link();
  run(1s);  // what was under way
  const Period cut = run(6s);
  expect_tracking(cut, "cut");
  EXPECT_EQ(cut.masks, 0);
  EXPECT_NE(near_->output().find("no other host offers segmentation"), std::string::npos)
      << near_->output();

  hosts_->set_link(50, 0.05);
  const Period back = run(15s, /*until_mask=*/true);
  expect_tracking(back, "back");
  ASSERT_TRUE(back.until_mask) << near_->output() << far_->output();
  const Period again = run(4s);
  expect_tracking(again, "after that");
  EXPECT_GE(again.masks, 4);
}

TEST_F(RemoteLink, IsNotNeededByTrackingWhereItsInterfaceGoesDown) {
  ASSERT_TRUE(run(20s, /*until_mask=*/true).until_mask) << near_->output() << far_->output();
  run(2s);
  ASSERT_TRUE(run_program("ip", {"link", "set", "robot0", "down"}).end.is_success());
  run(500ms);
  const Period down = run(5s);
  expect_tracking(down, "down");
  EXPECT_EQ(down.masks, 0);
  ASSERT_TRUE(run_program("ip", {"link", "set", "robot0", "up"}).end.is_success());
  const Period up = run(15s, /*until_mask=*/true);
  expect_tracking(up, "up");
  EXPECT_TRUE(up.until_mask) << near_->output() << far_->output();
}

}  // namespace
}  // namespace tsg::test
