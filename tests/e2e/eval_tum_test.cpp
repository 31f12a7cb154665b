// The way from the benchmark's site to the paper's tables: sequences are packed as the benchmark
// packs them, fetched by deploy/fetch-tum from a server on this machine, and run by `tsgctl
// eval-tum`.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "common/core/error.hpp"
#include "tests/e2e/tsgctl_run.hpp"
#include "tests/support/file_server.hpp"

namespace tsg::test {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr int kFrames = 20;
const std::string kFetchTum = std::string(TSG_SOURCE_DIR) + "/deploy/fetch-tum";
const std::string kFolder = "rgbd_dataset_freiburg3_walking_xyz";

void run_or_throw(const std::string& program, const std::vector<std::string>& arguments) {
  const ProgramResult result = run_program(program, arguments, kRunTimeout);
  if (result.end.exit_code != 0) throw std::runtime_error(program + ": " + result.output);
}

/// A shipped scene, seen at 10 Hz by the camera that the benchmark's third series was recorded
/// with.
void render(const fs::path& folder) {
  const TempFolder work;
  const std::string sensor =
      "\nsensor: {rate_hz: 10, fx: 535.4, fy: 539.2, cx: 320.1, cy: 247.6}\n";
  const std::string scene = content_of(TSG_SOURCE_DIR "/config/scenes/office_walking_xyz.yaml");
  simulate(folder, work.write("scene.yaml", scene + sensor).string(),
           {"--frames", std::to_string(kFrames)});
}

/// A site with one archive. The camera's calibration is not in it, as in the benchmark's; the true
/// masks are, which the benchmark does not have, so that removal can be tested without a network.
class EvalTum : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder = std::make_unique<TempFolder>();
    const fs::path sequence = *folder / kFolder;
    render(sequence);
    fs::remove(sequence / "camera.yaml");
    folder->write(kFolder + "/accelerometer.txt", "1305031098.6711 -0.0001 8.1716 -4.4\n");
    fs::create_directories(*folder / "site/freiburg3");
    run_or_throw("tar", {"-czf", (*folder / "site/freiburg3" / (kFolder + ".tgz")).string(), "-C",
                         folder->path().string(), kFolder});
    const FileServer server(*folder / "site");
    run_or_throw("env", {"TSG_TUM_URL=" + server.url(), "no_proxy=*", kFetchTum, "fr3/walking_xyz",
                         "--data", data()});
  }
  static void TearDownTestSuite() { folder.reset(); }

  static std::string data() { return (*folder / "data").string(); }

  [[nodiscard]] ProgramResult eval_tum(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), {"eval-tum", "--data", data(), "--out", out().string()});
    return run_program(TSG_BIN_DIR "/tsgctl", arguments, kRunTimeout);
  }
  [[nodiscard]] fs::path out() const { return out_ / "results"; }

  static std::unique_ptr<TempFolder> folder;
  TempFolder out_;
};
std::unique_ptr<TempFolder> EvalTum::folder;

TEST_F(EvalTum, RunsTheSequenceWithAndWithoutRemovalAndNamesWhatIsMissing) {
  const ProgramResult result = eval_tum({"--table", "4", "--segmentation", "dataset", "--json"});
  ASSERT_EQ(result.end.exit_code, 0) << result.output;
  const nlohmann::json json = json_of(result);
  ASSERT_EQ(json["sequences"].size(), 1U) << result.output;
  const nlohmann::json& entry = json["sequences"][0];
  EXPECT_EQ(entry["problem"], nullptr);
  for (const char* method : {"plain", "tsg"}) {
    EXPECT_EQ(entry[method]["frames"], kFrames) << method;
    EXPECT_EQ(entry[method]["ate_m"]["count"], kFrames) << method;
    EXPECT_GT(entry[method]["rpe_m"]["rmse"], 0.0) << method;
    EXPECT_EQ(entry[method]["rpe_delta"], "1 s") << method;
  }
  EXPECT_LT(entry["tsg"]["ate_m"]["rmse"], 0.01) << "its camera is known by its name";
  EXPECT_EQ(json["missing"], nlohmann::json({"fr3/walking_static"}));
  EXPECT_EQ(json["fetch"], "deploy/fetch-tum fr3/walking_static --data " + data());
  EXPECT_TRUE(fs::exists(out() / kFolder / "tsg/trajectory.txt"));
  EXPECT_TRUE(fs::exists(out() / kFolder / "plain/report.json"));
}

TEST_F(EvalTum, PrintsTablesOfThePlainRunWithoutMasks) {
  const ProgramResult result = eval_tum({"fr3/walking_xyz"});
  ASSERT_EQ(result.end.exit_code, 0) << result.output;
  EXPECT_THAT(result.output, AllOf(HasSubstr("Table 4"), HasSubstr("Table 5"), HasSubstr("0.7123"),
                                   HasSubstr("20/20"), HasSubstr("There were no masks")));
}

TEST_F(EvalTum, NamedSequenceThatIsMissingIsAnError) {
  const ProgramResult result = eval_tum({"fr1/desk"});
  EXPECT_EQ(result.end.exit_code, static_cast<int>(ExitCode::kMissingInput)) << result.output;
  EXPECT_THAT(result.output, HasSubstr("deploy/fetch-tum fr1/desk --data"));
}

TEST_F(EvalTum, MistakesAreToldBeforeAnythingRuns) {
  struct Mistake {
    std::vector<std::string> arguments;
    ExitCode code;
    const char* says;
  };
  const std::vector<Mistake> mistakes{
      {{"kitti/00"}, ExitCode::kUsage, "fr3/walking_xyz"},
      {{"--table", "7"}, ExitCode::kUsage, "--table"},
      {{"--segmentation", "model"}, ExitCode::kUsage, "--model FILE.onnx"},
      {{"--model", "absent.onnx"}, ExitCode::kMissingInput, "absent.onnx"},
      {{"--set", "slam.lockstep=false"}, ExitCode::kUsage, "slam.lockstep"}};
  for (const Mistake& mistake : mistakes) {
    const ProgramResult result = eval_tum(mistake.arguments);
    EXPECT_EQ(result.end.exit_code, static_cast<int>(mistake.code)) << result.output;
    EXPECT_THAT(result.output, HasSubstr(mistake.says));
    EXPECT_FALSE(fs::exists(out()));
  }
}

TEST_F(EvalTum, SequenceThatCannotBeRunIsTold) {
  const fs::path images = fs::path(data()) / kFolder / "rgb.txt";
  const std::string content = content_of(images);
  std::ofstream(images, std::ios::trunc) << "# nothing\n";
  const ProgramResult result = eval_tum({"fr3/walking_xyz"});
  std::ofstream(images, std::ios::trunc) << content;
  EXPECT_NE(result.end.exit_code, 0) << result.output;
  EXPECT_THAT(result.output, AllOf(HasSubstr("problem: "), HasSubstr("rgb.txt lists no image")));
}

}  // namespace
}  // namespace tsg::test
