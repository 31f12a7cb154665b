#include "common/app/run_service.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>
#include <string>
#include <thread>
#include <vector>

#include "common/core/error.hpp"

namespace tsg {
namespace {

constexpr ServiceInfo kInfo{.name = "slam", .description = "A service under test."};

/// Runs in a child process, where signals and exit codes are the real ones.
int run(std::vector<std::string> arguments,
        const std::function<void(const ServiceContext&)>& body) {
  arguments.insert(arguments.begin(), "tsg-slam");
  std::vector<char*> pointers;
  pointers.reserve(arguments.size());
  for (std::string& argument : arguments) pointers.push_back(argument.data());
  return run_service(static_cast<int>(pointers.size()), pointers.data(), kInfo, body);
}

using ::testing::ExitedWithCode;

[[noreturn]] void run_and_exit(const std::vector<std::string>& arguments,
                               const std::function<void(const ServiceContext&)>& body) {
  std::_Exit(run(arguments, body));
}

TEST(RunService, EndsWithZeroWhenItsBodyReturns) {
  EXPECT_EQ(run({}, [](const ServiceContext&) {}), 0);
}

TEST(RunService, TurnsAFatalErrorIntoItsMessageAndExitCode) {
  EXPECT_EXIT(run_and_exit({},
                           [](const ServiceContext&) {
                             throw FatalError(ExitCode::kUnavailable, "RouDi does not run");
                           }),
              ExitedWithCode(69), "tsg-slam: error: RouDi does not run");
}

TEST(RunService, RefusesAnArgumentThatItDoesNotKnow) {
  EXPECT_EXIT(run_and_exit({"--no-such"}, [](const ServiceContext&) {}), ExitedWithCode(64), "");
}

TEST(RunService, RefusesASectionThatNoServiceReads) {
  EXPECT_EXIT(run_and_exit({"--set", "slamm.count=1"}, [](const ServiceContext&) {}),
              ExitedWithCode(78), "unknown section 'slamm'");
}

TEST(RunService, StopsItsBodyOnSigterm) {
  const auto body = [](const ServiceContext& context) {
    kill(getpid(), SIGTERM);
    while (!context.stop.stop_requested()) std::this_thread::yield();
  };
  EXPECT_EXIT(run_and_exit({}, body), ExitedWithCode(0), "");
}

TEST(RunService, TellsItsBodyToCheckTheConfigurationOnly) {
  bool check_only = false;
  EXPECT_EQ(run({"--check-config"},
                [&](const ServiceContext& context) { check_only = context.check_config_only; }),
            0);
  EXPECT_TRUE(check_only);
}

}  // namespace
}  // namespace tsg
