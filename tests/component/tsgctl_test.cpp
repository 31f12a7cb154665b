// tsgctl as a user meets it: a process beside real endpoints, judged by its output and exit code.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <nlohmann/json.hpp>
#include <thread>

#include "common/bus/diagnostics.hpp"
#include "common/core/error.hpp"
#include "common/core/time.hpp"
#include "tests/support/run_program.hpp"
#include "tests/support/test_bus.hpp"

namespace tsg {
namespace {

using namespace std::chrono_literals;
using test::code;
using test::ProgramResult;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

const std::string kTsgctl = std::string(TSG_BIN_DIR) + "/tsgctl";

ProgramResult tsgctl(const std::vector<std::string>& arguments) {
  return test::run_program(kTsgctl, arguments);
}

/// Publishes on a thread of its own until it goes: tsgctl comes when it likes.
class Background {
 public:
  explicit Background(std::function<void()> publish)
      : thread_([publish = std::move(publish)](const std::stop_token& stop) {
          while (!stop.stop_requested()) {
            publish();
            std::this_thread::sleep_for(20ms);
          }
        }) {}

 private:
  std::jthread thread_;
};

tsg_TrackingStatus status_of(std::uint64_t seq) {
  tsg_TrackingStatus status{};
  status.header = {.seq = seq, .stamp_ns = 1, .publish_monotonic_ns = monotonic_ns()};
  status.state = tsg_TRACKING_OK;
  status.inliers = 321;
  return status;
}

Background publish_statuses(test::TestBus& bus) {
  auto& publisher = bus.publisher<topics::TrackingStatus>();
  return Background([&publisher, seq = std::uint64_t{0}]() mutable {
    (void)publisher.publish(status_of(seq++));
  });
}

TEST(TsgctlUsage, EveryCommandHasHelpWithExamples) {
  for (const char* command :
       {"run", "status", "topics", "echo", "hz", "doctor", "simulate", "eval-tum"}) {
    const ProgramResult result = tsgctl({command, "--help"});
    EXPECT_EQ(result.end.exit_code, 0) << command;
    EXPECT_THAT(result.output, HasSubstr("Examples:")) << command;
  }
}

TEST(TsgctlUsage, MistakesEndWith64AndSayWhatIsWrong) {
  struct Mistake {
    std::vector<std::string> arguments;
    const char* says;
  };
  const std::vector<Mistake> mistakes{
      {{}, "subcommand is required"},
      {{"run", "--out", "/tmp/out"}, "--input is required"},
      {{"run", "--input", ".", "--out", "o", "--pace", "slow"}, "--pace"},
      {{"run", "--input", ".", "--out", "o", "--segmentation", "off", "--model", "m.onnx"},
       "--model goes with --segmentation model"},
      {{"echo", "no/such/topic"}, "tsg/tracking_status"},
      {{"hz", "tsg/rgbd", "--window", "1"}, "--window"},
      {{"fly"}, "fly"}};
  for (const Mistake& mistake : mistakes) {
    const ProgramResult result = tsgctl(mistake.arguments);
    EXPECT_EQ(result.end.exit_code, code(ExitCode::kUsage)) << result.output;
    EXPECT_THAT(result.output, AllOf(HasSubstr("tsgctl: error:"), HasSubstr(mistake.says)));
  }
}

// Before any test that starts RouDi: tests run in the order of this file.
TEST(TsgctlWithoutRoudi, EchoOfImagesSaysHowToStartIt) {
  const ProgramResult result = tsgctl({"echo", "tsg/rgbd", "-n", "1"});
  EXPECT_EQ(result.end.exit_code, code(ExitCode::kUnavailable));
  EXPECT_THAT(result.output, AllOf(HasSubstr("RouDi"), HasSubstr("iox-roudi -c")));
}

TEST(TsgctlWithoutRoudi, StatusAndTopicsSayThatNothingRunsAndHowToStartIt) {
  for (const char* command : {"status", "topics"}) {
    const ProgramResult result = tsgctl({command});
    EXPECT_EQ(result.end.exit_code, code(ExitCode::kUnavailable)) << command;
    EXPECT_THAT(result.output, HasSubstr("tsgctl run --input")) << command;
  }
}

TEST(TsgctlWithoutRoudi, DoctorWarnsOfIt) {
  const ProgramResult result = tsgctl({"doctor"});
  EXPECT_THAT(result.output, AllOf(HasSubstr("does not run"), HasSubstr("iox-roudi")));
}

TEST(TsgctlEcho, PrintsMessagesAsJsonLines) {
  test::TestBus bus;
  const Background statuses = publish_statuses(bus);
  const ProgramResult result = tsgctl({"echo", "tsg/tracking_status", "-n", "2"});
  ASSERT_EQ(result.end.exit_code, 0) << result.output;
  std::istringstream lines(result.output);
  int count = 0;
  for (std::string line; std::getline(lines, line); ++count) {
    EXPECT_EQ(nlohmann::json::parse(line)["inliers"], 321) << line;
  }
  EXPECT_EQ(count, 2);
}

TEST(TsgctlEcho, SilentTopicIsATimeoutWithTheReason) {
  const test::TestBus bus;
  const ProgramResult result = tsgctl({"echo", "rt/tsg/pose", "-n", "1", "--timeout", "0.5"});
  EXPECT_EQ(result.end.exit_code, code(ExitCode::kTimeout));
  EXPECT_THAT(result.output, HasSubstr("nobody publishes rt/tsg/pose"));
}

TEST(TsgctlHz, TellsRateLatencyAndHoles) {
  test::TestBus bus;
  const Background statuses = publish_statuses(bus);
  const ProgramResult result = tsgctl({"hz", "tsg/tracking_status", "-n", "1"});
  EXPECT_EQ(result.end.exit_code, 0);
  EXPECT_THAT(result.output,
              AllOf(HasSubstr(" Hz  min "), HasSubstr("latency"), HasSubstr("missed 0")));
}

TEST(TsgctlTopics, ListsTypeDomainAndTransport) {
  test::TestBus bus;
  (void)bus.publisher<topics::TrackingStatus>();
  (void)bus.publisher<topics::Rgbd>();
  const ProgramResult result = tsgctl({"topics"});
  EXPECT_EQ(result.end.exit_code, 0) << result.output;
  EXPECT_THAT(result.output,
              AllOf(HasSubstr("tsg/rgbd"), HasSubstr("tsg::RgbdFrame"), HasSubstr("SHM"),
                    HasSubstr("tsg/tracking_status"), HasSubstr("UDP")));
}

TEST(TsgctlStatus, ShowsWhoSpeaksAndFailsForWhoDoesNot) {
  test::TestBus bus;
  DiagnosticsPublisher diagnostics(bus.bus(), "slam");
  const Background reports([&] {
    (void)diagnostics.publish({DiagnosticLevel::kOk, "tracking", {{"frames_dropped", "7"}}});
  });
  const ProgramResult result = tsgctl({"status"});
  EXPECT_EQ(result.end.exit_code, code(ExitCode::kFailure));
  EXPECT_THAT(result.output, AllOf(HasSubstr("tracking"), HasSubstr("7"),
                                   HasSubstr("not well or not running: camera, segmentation, "
                                             "map_server")));
}

TEST(TsgctlStatus, IsZeroWhenAllFourAreWell) {
  test::TestBus bus;
  std::vector<std::unique_ptr<DiagnosticsPublisher>> services;
  for (const char* name : {"camera", "segmentation", "slam", "map_server"}) {
    services.push_back(std::make_unique<DiagnosticsPublisher>(bus.bus(), name));
  }
  const Background reports([&] {
    for (auto& service : services) (void)service->publish({DiagnosticLevel::kOk, "well", {}});
  });
  const ProgramResult result = tsgctl({"status"});
  EXPECT_EQ(result.end.exit_code, 0) << result.output;
}

TEST(TsgctlDoctor, SeesRoudiAndItsPools) {
  const test::TestBus bus;
  const ProgramResult result = tsgctl({"doctor"});
  EXPECT_THAT(result.output, AllOf(HasSubstr("answers at /tmp/roudi"), HasSubstr("has them"),
                                   HasSubstr("works on lo"), Not(HasSubstr("FAIL  pools"))));
}

}  // namespace
}  // namespace tsg
