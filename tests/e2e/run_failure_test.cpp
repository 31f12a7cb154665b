// What goes wrong in a run: each case with its own exit code and a message that names the thing
// and the fix; and no process is left behind.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <fstream>
#include <functional>
#include <set>

#include "tests/e2e/tsgctl_run.hpp"
#include "tests/support/tiny_disk.hpp"
#include "tests/support/wait.hpp"

namespace tsg::test {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;
using ::testing::AllOf;
using ::testing::HasSubstr;

/// The name of a process as the kernel shortens it; empty where it is gone.
std::string name_of(const fs::path& process) {
  std::string name = test::content_of(process / "comm");
  if (!name.empty()) name.pop_back();
  return name;
}

/// Ids of running processes of that (shortened) name that this test started, directly or not.
std::set<pid_t> processes_named(const std::string& name) {
  std::set<pid_t> found;
  for (const auto& entry : fs::directory_iterator("/proc")) {
    const std::string number = entry.path().filename().string();
    if (number.find_first_not_of("0123456789") != std::string::npos) continue;
    if (name_of(entry.path()) != name) continue;
    std::error_code ignored;  // gone meanwhile, or another user's
    const bool is_ours = fs::equivalent(entry.path() / "ns/mnt", "/proc/self/ns/mnt", ignored);
    if (is_ours && !ignored) found.insert(static_cast<pid_t>(std::stol(number)));
  }
  return found;
}

void expect_no_process_left() {
  for (const char* name :
       {"tsg-camera", "tsg-segmentatio", "tsg-slam", "tsg-map-server", "iox-roudi", "tsgctl"}) {
    EXPECT_TRUE(eventually(1s, [&] { return processes_named(name).empty(); })) << name;
  }
}

/// A copy of the simulated room to damage.
class DamagedRoom {
 public:
  DamagedRoom() { fs::copy(simulated_room(), path(), fs::copy_options::recursive); }
  [[nodiscard]] fs::path path() const { return folder_ / "room"; }
  /// Some file of rgb/ or depth/, the fifth in time.
  [[nodiscard]] fs::path fifth_of(const std::string& kind) const {
    std::set<fs::path> files;
    for (const auto& entry : fs::directory_iterator(path() / kind)) files.insert(entry.path());
    return *std::next(files.begin(), 4);
  }

 private:
  TempFolder folder_;
};

void expect_failure(const fs::path& input,
                    const std::vector<std::string>& options,
                    ExitCode code,
                    const ::testing::Matcher<std::string>& says) {
  TsgctlRun run(input, options);
  const ProgramResult result = run.run();
  EXPECT_EQ(result.end.exit_code, static_cast<int>(code)) << result.output;
  EXPECT_THAT(result.output, AllOf(HasSubstr("tsgctl: error:"), says));
  expect_no_process_left();
}

TEST(RunFailure, MissingFolderIsNamed) {
  expect_failure("/no/such/sequence", {}, ExitCode::kMissingInput, HasSubstr("/no/such/sequence"));
}

TEST(RunFailure, EmptyListIsNamed) {
  const DamagedRoom room;
  std::ofstream(room.path() / "rgb.txt") << "# nothing\n";
  expect_failure(room.path(), {}, ExitCode::kEmptyInput, HasSubstr("rgb.txt"));
}

TEST(RunFailure, TruncatedPngIsNamed) {
  const DamagedRoom room;
  const fs::path image = room.fifth_of("rgb");
  fs::resize_file(image, fs::file_size(image) / 2);
  expect_failure(room.path(), {"--pace", "lockstep"}, ExitCode::kBadData,
                 HasSubstr(image.filename().string()));
}

TEST(RunFailure, DepthOfAnotherSizeIsNamed) {
  const DamagedRoom room;
  const TempFolder small;
  simulate(small / "room", "demo", {"--frames", "5", "--size", "320x240"});
  const fs::path image = room.fifth_of("depth");
  fs::copy_file(small / "room/depth" / image.filename(), image,
                fs::copy_options::overwrite_existing);
  expect_failure(room.path(), {"--pace", "lockstep"}, ExitCode::kSizeMismatch,
                 AllOf(HasSubstr(image.filename().string()), HasSubstr("320x240")));
}

TEST(RunFailure, NanInGroundTruthIsNamedWithItsLine) {
  const DamagedRoom room;
  std::ofstream(room.path() / "groundtruth.txt", std::ios::app) << "1700000099.0 nan 0 0 0 0 0 1\n";
  expect_failure(room.path(), {}, ExitCode::kInvalidNumber, HasSubstr("groundtruth.txt"));
}

TEST(RunFailure, UnknownConfigurationKeyIsNamed) {
  const TempFolder temp;
  const fs::path config = temp.write("typo.yaml", "slam:\n  max_featurs: 800\n");
  expect_failure(simulated_room(), {"--config", config.string()}, ExitCode::kConfig,
                 AllOf(HasSubstr("max_featurs"), HasSubstr("typo.yaml")));
}

TEST(RunFailure, UnknownSectionOfAnOverrideIsNamed) {
  expect_failure(simulated_room(), {"--set", "slum.lockstep=true"}, ExitCode::kConfig,
                 HasSubstr("slum"));
}

TEST(RunFailure, FileThatIsNoNetworkIsNamed) {
  const TempFolder temp;
  const fs::path model = temp.write("model.onnx", "not a network");
  expect_failure(simulated_room(), {"--segmentation", "model", "--model", model.string()},
                 ExitCode::kBadData, HasSubstr("model.onnx"));
}

ProgramResult run_into(const fs::path& out) {
  return run_program(TSG_BIN_DIR "/tsgctl",
                     {"run", "--input", simulated_room().string(), "--out", out.string()},
                     kRunTimeout);
}

TEST(RunFailure, DiskThatIsTooSmallIsToldBeforeAnythingStarts) {
  const TinyDisk disk("256k");
  if (!disk.is_mounted()) GTEST_SKIP() << "no right to mount: a full disk cannot be made here";
  const ProgramResult result = run_into(disk.path() / "out");
  EXPECT_EQ(result.end.exit_code, static_cast<int>(ExitCode::kCannotWrite)) << result.output;
  EXPECT_THAT(result.output, AllOf(HasSubstr(disk.path().string()), HasSubstr("make room")));
  expect_no_process_left();
}

TEST(RunFailure, DiskThatFillsUpDuringTheRunIsToldAtSaving) {
  const TinyDisk disk("32m");
  if (!disk.is_mounted()) GTEST_SKIP() << "no right to mount: a full disk cannot be made here";
  RunningProgram run(TSG_BIN_DIR "/tsgctl", {"run", "--input", simulated_room().string(), "--out",
                                             (disk.path() / "out").string(), "--pace", "lockstep"});
  ASSERT_TRUE(eventually(60s, [] { return !processes_named("tsg-camera").empty(); }));
  disk.fill();
  const ProgramResult result = run.wait(kRunTimeout);
  EXPECT_EQ(result.end.exit_code, static_cast<int>(ExitCode::kCannotWrite)) << result.output;
  EXPECT_THAT(result.output, HasSubstr(disk.path().string()));
  expect_no_process_left();
}

/// What makes a run last until it is stopped.
const std::vector<std::string> kEndless{"--set", "camera.replay.loop=true"};

/// Returns once the first frames have been tracked.
void wait_until_under_way(const RunningProgram& program) {
  ASSERT_TRUE(eventually(60s, [&] { return program.output().find("fps") != std::string::npos; }))
      << program.output();
}

TEST(RunInterrupted, CtrlCStopsAllWithinTwoSecondsAndKeepsWhatThereIs) {
  const TsgctlRun run(simulated_room(), kEndless);
  RunningProgram program = run.start();
  wait_until_under_way(program);
  const auto start = std::chrono::steady_clock::now();
  program.child().signal(SIGINT);
  const ProgramResult result = program.wait(30s);
  EXPECT_LT(std::chrono::steady_clock::now() - start, 2s);
  EXPECT_EQ(result.end.exit_code, static_cast<int>(ExitCode::kInterrupted)) << result.output;
  EXPECT_EQ(run.report()["completed"], false);
  EXPECT_THAT(run.report()["problem"].get<std::string>(), HasSubstr("Ctrl-C"));
  expect_no_process_left();
}

TEST(RunInterrupted, SigtermHasACodeOfItsOwn) {
  const TsgctlRun run(simulated_room(), kEndless);
  RunningProgram program = run.start();
  wait_until_under_way(program);
  program.child().signal(SIGTERM);
  EXPECT_EQ(program.wait(30s).end.exit_code, static_cast<int>(ExitCode::kTerminated));
  expect_no_process_left();
}

TEST(RunInterrupted, KilledTsgctlLeavesNoServiceBehind) {
  const TsgctlRun run(simulated_room(), kEndless);
  RunningProgram program = run.start();
  wait_until_under_way(program);
  kill(program.child().pid(), SIGKILL);  // it alone, not its group
  (void)program.wait(30s);
  expect_no_process_left();
}

TEST(RunInterrupted, KilledSlamEndsTheRunAndIsNamed) {
  const TsgctlRun run(simulated_room(), kEndless);
  RunningProgram program = run.start();
  wait_until_under_way(program);
  const std::set<pid_t> slam = processes_named("tsg-slam");
  ASSERT_EQ(slam.size(), 1U);
  kill(*slam.begin(), SIGKILL);
  const ProgramResult result = program.wait(30s);
  EXPECT_EQ(result.end.exit_code, static_cast<int>(ExitCode::kServiceDied)) << result.output;
  EXPECT_THAT(result.output, AllOf(HasSubstr("slam ended unexpectedly"), HasSubstr("signal 9")));
  expect_no_process_left();
}

}  // namespace
}  // namespace tsg::test
