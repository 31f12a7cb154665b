#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "common/app/child_process.hpp"
#include "common/bus/convert.hpp"
#include "tests/support/temp_folder.hpp"
#include "tests/support/test_bus.hpp"
#include "tests/support/textured_wall.hpp"

namespace tsg::test {

inline constexpr std::chrono::seconds kPatience{20};  // sanitizers on a busy machine

/// tsg-slam in a process of its own, and the rest of the system played by the test.
class SlamService : public ::testing::Test {
 protected:
  void start(const std::vector<std::string>& settings) {
    ChildCommand command{.program = TSG_BIN_DIR "/tsg-slam", .output_file = log_};
    for (const std::string& setting : settings) {
      command.arguments.insert(command.arguments.end(), {"--set", setting});
    }
    process_.emplace(value_or_throw(ChildProcess::spawn(command)));
  }

  void send(const RgbdFrame& frame) {
    auto& publisher = bus_.publisher<topics::Rgbd>();
    ASSERT_TRUE(publisher.wait_for_subscribers(1, kPatience)) << content_of(log_);
    auto loan = publisher.loan();
    ASSERT_TRUE(loan) << loan.error().message;
    ASSERT_TRUE(fill_message(frame, **loan));
    ASSERT_TRUE(publisher.publish(std::move(*loan)));
  }

  /// The answer to frame `seq`.
  std::optional<Sample<topics::TrackingStatus>> status_of(std::uint64_t seq) {
    return bus_.wait_for<topics::TrackingStatus>(
        kPatience, [seq](const auto& status) { return status.header.seq == seq; });
  }

  /// Sends frame and waits for the answer; its state, if there is one.
  std::optional<tsg_TrackingState> track(const RgbdFrame& frame) {
    static_cast<void>(bus_.subscriber<topics::TrackingStatus>());
    send(frame);
    const auto status = status_of(frame.seq);
    return status ? std::optional((*status)->state) : std::nullopt;
  }

  ChildExit stop() {
    process_->signal(SIGTERM);
    return wait_for_end();
  }

  /// How it ends by itself.
  ChildExit wait_for_end() {
    return process_->wait(kPatience).value_or(ChildExit{.exit_code = -1});
  }

  TempFolder folder_;
  std::filesystem::path log_ = folder_ / "slam.log";
  TestBus bus_;
  TexturedWall wall_;
  std::optional<ChildProcess> process_;
};

}  // namespace tsg::test
