#include "services/tsgctl/run/supervisor.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <fstream>

#include "tests/support/wait.hpp"

namespace tsg {
namespace {

using std::chrono::milliseconds;
using ::testing::HasSubstr;

constexpr milliseconds kLong{5000};

/// A folder for logs that goes with the test.
class SupervisorTest : public ::testing::Test {
 protected:
  SupervisorTest() { std::filesystem::create_directories(folder_); }
  ~SupervisorTest() override { std::filesystem::remove_all(folder_); }
  SupervisorTest(const SupervisorTest&) = delete;
  SupervisorTest& operator=(const SupervisorTest&) = delete;
  SupervisorTest(SupervisorTest&&) = delete;
  SupervisorTest& operator=(SupervisorTest&&) = delete;

  /// A service that is a shell script.
  static ProcessPlan script(const std::string& service, const std::string& text) {
    return {service, "/bin/sh", {"-c", text}};
  }

  /// Runs a script to its end and returns what check_alive() throws about it.
  FatalError death_of(const std::string& text) {
    supervisor_.start(script("slam", text));
    try {
      supervisor_.wait_ready("slam", kLong, {});
    } catch (const FatalError& error) {
      return error;
    }
    ADD_FAILURE() << "nobody noticed the end of: " << text;
    return {ExitCode::kFailure, ""};
  }

  std::filesystem::path folder_ = std::filesystem::temp_directory_path() /
                                  ("supervisor_test_" + std::to_string(getpid()) + "_" +
                                   ::testing::UnitTest::GetInstance()->current_test_info()->name());
  Supervisor supervisor_{folder_};
};

TEST_F(SupervisorTest, ServiceThatNamesItsFailureGivesItsExitCodeAndItsWords) {
  const FatalError error = death_of("echo 'error: unknown key max_featurs' >&2; exit 78");
  EXPECT_EQ(error.code(), ExitCode::kConfig);
  EXPECT_THAT(error.what(), HasSubstr("slam ended unexpectedly: exit code 78"));
  EXPECT_THAT(error.what(), HasSubstr("unknown key max_featurs"));
}

TEST_F(SupervisorTest, KilledServiceIsAServiceThatDied) {
  const FatalError error = death_of("kill -9 $$");
  EXPECT_EQ(error.code(), ExitCode::kServiceDied);
  EXPECT_THAT(error.what(), HasSubstr("killed by signal 9"));
  EXPECT_THAT(error.what(), HasSubstr("wrote nothing"));
}

TEST_F(SupervisorTest, ServiceThatEndsWithoutFailureBeforeItsTimeIsAServiceThatDied) {
  EXPECT_EQ(death_of("exit 0").code(), ExitCode::kServiceDied);
}

TEST_F(SupervisorTest, MissingExecutableIsNamed) {
  try {
    supervisor_.start({"slam", "/nowhere/tsg-slam", {}});
    FAIL() << "a missing executable was started";
  } catch (const FatalError& error) {
    EXPECT_EQ(error.code(), ExitCode::kUnavailable);
    EXPECT_THAT(error.what(), HasSubstr("/nowhere/tsg-slam"));
  }
}

TEST_F(SupervisorTest, ServiceThatNeverGetsReadyIsATimeout) {
  supervisor_.start(script("slam", "sleep 60"));
  try {
    supervisor_.wait_ready("slam", milliseconds(100), {});
    FAIL() << "a silent service counts as ready";
  } catch (const FatalError& error) {
    EXPECT_EQ(error.code(), ExitCode::kTimeout);
  }
}

TEST_F(SupervisorTest, StopRequestEndsTheWait) {
  supervisor_.start(script("slam", "sleep 60"));
  std::stop_source stop;
  stop.request_stop();
  EXPECT_FALSE(supervisor_.wait_ready("slam", kLong, stop.get_token()));
}

TEST_F(SupervisorTest, CameraMayFinishOthersMayNot) {
  supervisor_.start(script("camera", "exit 0"));
  while (!supervisor_.has_finished("camera")) {
  }
  EXPECT_NO_THROW(supervisor_.check_alive("camera"));
  EXPECT_THROW(supervisor_.check_alive("slam"), FatalError);
}

TEST_F(SupervisorTest, StopAllKillsWhatIgnoresTermAndKeepsToItsBudget) {
  const auto deaf = folder_ / "deaf";
  supervisor_.start(
      script("slam", "trap '' TERM; : >'" + deaf.string() + "'; while :; do sleep 1; done"));
  supervisor_.start(script("camera", "sleep 60"));
  ASSERT_TRUE(test::eventually(kLong, [&] { return std::filesystem::exists(deaf); }));
  const auto start = std::chrono::steady_clock::now();
  supervisor_.stop_all("camera", milliseconds(500));
  EXPECT_LT(std::chrono::steady_clock::now() - start, milliseconds(1500));
  EXPECT_FALSE(supervisor_.is_running("slam"));
  const std::vector<ProcessUse> uses = supervisor_.uses();
  ASSERT_EQ(uses.size(), 2U);
  EXPECT_EQ(uses[0].service, "camera");
  EXPECT_THAT(uses[0].end, HasSubstr("signal 15"));
  EXPECT_THAT(uses[1].end, HasSubstr("signal 9"));
}

TEST(ExitCodeAfter, PassesOnCodesThatNameAFailureOnly) {
  EXPECT_EQ(exit_code_after({.exit_code = 65}), ExitCode::kBadData);
  EXPECT_EQ(exit_code_after({.exit_code = 1}), ExitCode::kServiceDied);
  EXPECT_EQ(exit_code_after({.exit_code = 70}), ExitCode::kServiceDied);
  EXPECT_EQ(exit_code_after({.exit_code = 0}), ExitCode::kServiceDied);
  EXPECT_EQ(exit_code_after({.signal = SIGSEGV}), ExitCode::kServiceDied);
}

}  // namespace
}  // namespace tsg
