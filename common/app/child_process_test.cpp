#include "common/app/child_process.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace tsg {
namespace {

using namespace std::chrono_literals;
using ::testing::HasSubstr;

ChildProcess shell(const std::string& script, const std::filesystem::path& output = {}) {
  return value_or_throw(ChildProcess::spawn({.program = "sh",
                                             .arguments = {"-c", script},
                                             .environment = {{"TSG_WORD", "hello"}},
                                             .output_file = output}));
}

TEST(ChildProcess, ReportsTheExitCode) {
  ChildProcess child = shell("exit 66");
  const auto& ended = child.wait(10s);
  ASSERT_TRUE(ended);
  EXPECT_EQ(ended->exit_code, 66);
  EXPECT_EQ(ended->describe(), "exit code 66");
  EXPECT_GT(ended->peak_rss_mib, 0.1);
}

TEST(ChildProcess, ReportsTheSignalThatKilledIt) {
  ChildProcess child = shell("exec sleep 60");
  child.signal(SIGKILL);
  const auto& ended = child.wait(10s);
  ASSERT_TRUE(ended);
  EXPECT_EQ(ended->signal, SIGKILL);
  EXPECT_FALSE(ended->is_success());
}

TEST(ChildProcess, IsStillThereAfterAWaitThatTimesOut) {
  ChildProcess child = shell("exec sleep 60");
  EXPECT_FALSE(child.wait(10ms));
  EXPECT_EQ(child.terminate(10s).signal, SIGTERM);
}

TEST(ChildProcess, IsKilledWhenItIgnoresTermination) {
  ChildProcess child = shell("trap '' TERM; while :; do sleep 1; done");
  EXPECT_FALSE(child.wait(200ms));  // until the trap is set
  EXPECT_EQ(child.terminate(100ms).signal, SIGKILL);
}

TEST(ChildProcess, PassesTheEnvironmentAndCapturesTheOutput) {
  const auto path = std::filesystem::temp_directory_path() / "tsg_child_process_output";
  std::filesystem::remove(path);
  ChildProcess child = shell("echo $TSG_WORD; echo $TSG_WORD >&2", path);
  ASSERT_TRUE(child.wait(10s));
  std::stringstream text;
  text << std::ifstream(path).rdbuf();
  EXPECT_EQ(text.str(), "hello\nhello\n");
  std::filesystem::remove(path);
}

TEST(ChildProcess, NamesTheProgramThatIsNotThere) {
  const auto child = ChildProcess::spawn({.program = "no-such-program"});
  ASSERT_FALSE(child);
  EXPECT_EQ(child.error().code, ExitCode::kUnavailable);
  EXPECT_THAT(child.error().message, HasSubstr("no-such-program"));
}

TEST(ChildProcess, LeavesNothingBehindWhenItGoesOutOfScope) {
  pid_t pid = 0;
  {
    const ChildProcess child = shell("exec sleep 60");
    pid = child.pid();
  }
  EXPECT_EQ(kill(pid, 0), -1);
}

TEST(ChildProcess, MayTidyUpWhenItGoesOutOfScope) {
  const std::filesystem::path path =
      std::filesystem::temp_directory_path() / ("tidied_" + std::to_string(getpid()));
  {
    ChildProcess child = shell("trap 'rm " + path.string() + "; exit' TERM; touch " +
                               path.string() + "; while :; do sleep 0.02; done");
    for (int i = 0; i < 500 && !std::filesystem::exists(path); ++i) {
      static_cast<void>(child.wait(10ms));
    }
    ASSERT_TRUE(std::filesystem::exists(path));
  }
  EXPECT_FALSE(std::filesystem::exists(path));
}

}  // namespace
}  // namespace tsg
