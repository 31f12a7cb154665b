// `tsgctl bench slam` as a user meets it, on a short simulated sequence.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "common/dataset/trajectory.hpp"
#include "tests/e2e/tsgctl_run.hpp"

namespace tsg {
namespace {

using test::code;
using test::json_of;
using test::ProgramResult;
using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr int kFrames = 12;

ProgramResult bench(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), {"bench", "slam"});
  return test::run_program(TSG_BIN_DIR "/tsgctl", arguments, test::kRunTimeout);
}

class BenchSlam : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder = std::make_unique<test::TempFolder>();
    test::simulate(room(), "demo", {"--frames", std::to_string(kFrames), "--size", "320x240"});
  }
  static void TearDownTestSuite() { folder.reset(); }

  static std::string path(const std::string& name) { return (*folder / name).string(); }
  static std::string room() { return path("room"); }

  static std::unique_ptr<test::TempFolder> folder;
};
std::unique_ptr<test::TempFolder> BenchSlam::folder;

TEST_F(BenchSlam, TellsTimesMapMemoryAndErrorAsText) {
  const ProgramResult result = bench({room()});
  ASSERT_EQ(result.end.exit_code, 0) << result.output;
  EXPECT_THAT(result.output,
              AllOf(HasSubstr("320x240, with true masks"), HasSubstr("extract"),
                    HasSubstr("mapping"), HasSubstr("frames     12, 0 without a pose"),
                    HasSubstr("ATE        rmse 0.0"), HasSubstr("MiB")));
}

TEST_F(BenchSlam, StagesAddUpAndTheTrajectoryIsThatOfTheRun) {
  const ProgramResult result = bench({room(), "--json", "--out", path("trajectory.txt")});
  ASSERT_EQ(result.end.exit_code, 0) << result.output;
  const nlohmann::json json = json_of(result);
  double stages_ms = 0.0;
  for (const char* stage : {"extract", "match", "optimise", "decide"}) {
    stages_ms += json["cpu_ms"][stage]["mean"].get<double>();
  }
  const double tracking_ms = json["cpu_ms"]["tracking"]["mean"];
  EXPECT_GT(tracking_ms, 0.0);
  EXPECT_NEAR(stages_ms, tracking_ms, 1e-6);
  EXPECT_LT(json["ate_m"]["rmse"], 0.03);
  EXPECT_EQ(value_or_throw(read_trajectory(path("trajectory.txt"))).size(), kFrames);
}

TEST_F(BenchSlam, MakesMasksLateAndWrongOnRequest) {
  const auto trajectory = [](const std::vector<std::string>& faults) {
    std::vector<std::string> arguments{room(), "--out", path("faulty.txt")};
    arguments.insert(arguments.end(), faults.begin(), faults.end());
    const ProgramResult result = bench(arguments);
    EXPECT_EQ(result.end.exit_code, 0) << result.output;
    return test::content_of(path("faulty.txt"));
  };
  EXPECT_NE(trajectory({"--mask-fault", "drop_every=1"}), trajectory({}));
}

TEST_F(BenchSlam, TellsWhatIsWrongWithAMaskFault) {
  const ProgramResult result =
      bench({room(), "--mask-fault", "late_frames=-1", "--mask-fault", "late=2"});
  EXPECT_EQ(result.end.exit_code, code(ExitCode::kConfig)) << result.output;
  EXPECT_THAT(result.output, AllOf(HasSubstr("mask-fault.late_frames must be 0 to 300"),
                                   HasSubstr("unknown key mask-fault.late")));
}

TEST_F(BenchSlam, GoesRoundWithASeriesAndAPicture) {
  const ProgramResult result = bench({room(), "--frames", "5", "--laps", "3", "--no-masks",
                                      "--series", path("series.csv"), "--plot", path("p.png")});
  ASSERT_EQ(result.end.exit_code, 0) << result.output;
  EXPECT_THAT(result.output, AllOf(HasSubstr("without masks"), HasSubstr("lap 3")));
  const std::string series = test::content_of(path("series.csv"));
  EXPECT_EQ(std::count(series.begin(), series.end(), '\n'), 1 + 15);
  EXPECT_THAT(test::content_of(path("p.png")), HasSubstr("PNG"));
}

TEST_F(BenchSlam, MistakesAreToldWithTheirCode) {
  struct Mistake {
    std::vector<std::string> arguments;
    ExitCode code;
    const char* says;
  };
  const std::vector<Mistake> mistakes{
      {{path("absent")}, ExitCode::kMissingInput, "there is no folder"},
      {{}, ExitCode::kUsage, "DIR is required"},
      {{room(), "--laps", "0"}, ExitCode::kUsage, "--laps"},
      {{room(), "--frames", "1", "--laps", "2"}, ExitCode::kEmptyInput, "leave out --laps"},
      {{room(), "--set", "slam.features.max_featurs=1"}, ExitCode::kConfig, "max_featurs"},
      {{room(), "--set", "camera.pace=lockstep"}, ExitCode::kUsage, "only slam runs here"},
      {{room(), "--out", path("absent/t.txt")}, ExitCode::kCannotWrite, "make it first"}};
  for (const Mistake& mistake : mistakes) {
    const ProgramResult result = bench(mistake.arguments);
    EXPECT_EQ(result.end.exit_code, code(mistake.code)) << result.output;
    EXPECT_THAT(result.output, HasSubstr(mistake.says));
  }
}

TEST_F(BenchSlam, AnImageThatIsDamagedIsNamed) {
  std::filesystem::copy(room(), path("holed"), std::filesystem::copy_options::recursive);
  const auto image = *std::filesystem::directory_iterator(path("holed") + "/depth");
  std::ofstream(image.path(), std::ios::trunc) << "no image";
  const ProgramResult result = bench({path("holed")});
  EXPECT_EQ(result.end.exit_code, code(ExitCode::kBadData)) << result.output;
  EXPECT_THAT(result.output, HasSubstr(image.path().filename().string()));
}

}  // namespace
}  // namespace tsg
