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
inline constexpr std::chrono::seconds kBeforeRepeat{10};

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

  /// What `wait_for_answer(patience)` gives once `frame` is sent, and sent again where no answer
  /// came: like a camera's, a frame is lost that is sent before slam has discovered its publisher.
  template <typename WaitForAnswer>
  auto send_until(const RgbdFrame& frame, const WaitForAnswer& wait_for_answer) {
    send(frame);
    auto answer = wait_for_answer(kBeforeRepeat);
    if (answer) return answer;
    send(frame);
    return wait_for_answer(kPatience);
  }

  /// The answer to frame `seq`.
  std::optional<Sample<topics::TrackingStatus>> status_of(
      std::uint64_t seq, std::chrono::milliseconds patience = kPatience) {
    return bus_.wait_for<topics::TrackingStatus>(
        patience, [seq](const auto& status) { return status.header.seq == seq; });
  }

  /// Sends frame and waits for the answer.
  std::optional<Sample<topics::TrackingStatus>> answer_to(const RgbdFrame& frame) {
    static_cast<void>(bus_.subscriber<topics::TrackingStatus>());
    return send_until(
        frame, [&](std::chrono::milliseconds patience) { return status_of(frame.seq, patience); });
  }
  /// Its state, if there is one.
  std::optional<tsg_TrackingState> track(const RgbdFrame& frame) {
    const auto status = answer_to(frame);
    return status ? std::optional((*status)->state) : std::nullopt;
  }

  /// How slam ends of `frame`, if it does.
  std::optional<ChildExit> end_of(const RgbdFrame& frame) {
    return send_until(frame,
                      [&](std::chrono::milliseconds patience) { return process_->wait(patience); });
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
