// `tsgctl eval dynamic` and `tsgctl report methods` as a user meets them, on a few simulated
// frames.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "tests/e2e/tsgctl_run.hpp"

namespace tsg {
namespace {

using test::code;
using test::json_of;
using test::ProgramResult;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr int kFrames = 10;

ProgramResult tsgctl(const std::vector<std::string>& arguments) {
  return test::run_program(TSG_BIN_DIR "/tsgctl", arguments, test::kRunTimeout);
}

class EvalDynamic : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder = std::make_unique<test::TempFolder>();
    test::simulate(crowd(), "crowd", {"--frames", std::to_string(kFrames), "--size", "320x240"});
  }
  static void TearDownTestSuite() { folder.reset(); }

  static std::string path(const std::string& name) { return (*folder / name).string(); }
  static std::string crowd() { return path("crowd"); }

  /// The sequence without what tells the truth.
  static std::string plain() {
    std::string copy = path("plain");
    if (std::filesystem::exists(copy)) return copy;
    std::filesystem::copy(crowd(), copy, std::filesystem::copy_options::recursive);
    std::filesystem::remove_all(copy + "/mask");
    std::filesystem::remove(copy + "/instances.json");
    return copy;
  }

  static std::unique_ptr<test::TempFolder> folder;
};
std::unique_ptr<test::TempFolder> EvalDynamic::folder;

TEST_F(EvalDynamic, ComparesVerdictsWithTheTruthForPrograms) {
  const ProgramResult result = tsgctl({"eval", "dynamic", crowd(), "--json"});
  ASSERT_EQ(result.end.exit_code, 0) << result.output;
  const nlohmann::json json = json_of(result);
  EXPECT_EQ(json["frames"], kFrames);
  EXPECT_EQ(json["method"], "full");
  EXPECT_EQ(json["masks"], "true masks");
  EXPECT_GT(json["total"]["recall"], 0.9);
  EXPECT_GT(json["total"]["precision"], 0.5);
  EXPECT_GT(json["classes"]["person"]["moving"]["removed"], 20 * kFrames);
  EXPECT_GT(json["features_per_frame"]["static_things"]["left"], 50.0);
  const auto features = [&](const char* part) {
    std::uint64_t count = 0;
    for (const char* state : {"still", "moving", "at_rest", "unknown"}) {
      count += json[part][state]["removed"].get<std::uint64_t>();
      count += json[part][state]["kept"].get<std::uint64_t>();
    }
    return count;
  };
  EXPECT_GT(features("at_edge"), 0U);
  EXPECT_EQ(features("total") + features("at_edge"), features("with_edges"));
}

TEST_F(EvalDynamic, WithoutMarginNothingIsAtAnEdge) {
  const ProgramResult result =
      tsgctl({"eval", "dynamic", crowd(), "--json", "--frames", "3", "--margin-px", "0"});
  ASSERT_EQ(result.end.exit_code, 0) << result.output;
  const nlohmann::json json = json_of(result);
  EXPECT_EQ(json["frames"], 3);
  EXPECT_EQ(json["total"], json["with_edges"]);
}

TEST_F(EvalDynamic, WritesTablesSeriesAndPictures) {
  const ProgramResult result =
      tsgctl({"eval", "dynamic", crowd(), "--csv", path("frames.csv"), "--debug", path("pictures"),
              "--debug-every", "4", "--mask-fault", "late_frames=2", "--method", "mask"});
  ASSERT_EQ(result.end.exit_code, 0) << result.output;
  EXPECT_THAT(result.output,
              AllOf(HasSubstr("method mask, masks with late_frames=2"), HasSubstr("recall"),
                    HasSubstr("dynamic classes"), HasSubstr("ATE rmse")));
  const std::string series = test::content_of(path("frames.csv"));
  EXPECT_EQ(std::count(series.begin(), series.end(), '\n'), 1 + kFrames);
  for (const char* name : {"000000.png", "000004.png", "000008.png"}) {
    EXPECT_THAT(test::content_of(path("pictures") + "/" + name), HasSubstr("PNG")) << name;
  }
  EXPECT_FALSE(std::filesystem::exists(path("pictures") + "/000001.png"));
}

TEST_F(EvalDynamic, MistakesAreToldWithTheirCode) {
  struct Mistake {
    std::vector<std::string> arguments;
    ExitCode code;
    const char* says;
  };
  const std::vector<Mistake> mistakes{
      {{path("absent")}, ExitCode::kMissingInput, "there is no folder"},
      {{plain()}, ExitCode::kMissingInput, "'tsgctl simulate SCENE --out DIR' makes one"},
      {{crowd(), "--method", "magic"}, ExitCode::kUsage, "epipolar"},
      {{crowd(), "--method", "tsg", "--set", "slam.dynamic_filter.method=none"},
       ExitCode::kUsage,
       "give one of them"},
      {{crowd(), "--mask-fault", "latest=1"}, ExitCode::kConfig, "latest"},
      {{crowd(), "--margin-px", "-1"}, ExitCode::kUsage, "--margin-px"},
      {{crowd(), "--debug-every", "0"}, ExitCode::kUsage, "--debug-every"},
      {{crowd(), "--csv", path("absent/f.csv")}, ExitCode::kCannotWrite, "f.csv"},
      {{crowd(), "--debug", "/proc/pictures"}, ExitCode::kCannotWrite, "/proc/pictures"}};
  for (Mistake mistake : mistakes) {
    mistake.arguments.insert(mistake.arguments.begin(), {"eval", "dynamic"});
    const ProgramResult result = tsgctl(mistake.arguments);
    EXPECT_EQ(result.end.exit_code, code(mistake.code)) << result.output;
    EXPECT_THAT(result.output, HasSubstr(mistake.says));
  }
}

TEST_F(EvalDynamic, RunHasNoPicturesOfWhatANetworkSees) {
  const ProgramResult result = tsgctl({"run", "--input", crowd(), "--out", path("out"), "--debug",
                                       "--segmentation", "model", "--model", "net.onnx"});
  EXPECT_EQ(result.end.exit_code, code(ExitCode::kUsage)) << result.output;
  EXPECT_THAT(result.output, HasSubstr("--segmentation dataset or off"));
  EXPECT_FALSE(std::filesystem::exists(path("out")));
}

TEST_F(EvalDynamic, ReportRunsEveryMethodOnEverySequence) {
  const ProgramResult result =
      tsgctl({"report", "methods", crowd(), plain(), "--methods", "mask,full", "--variants",
              "late3,nomasks", "--frames", "6", "--out", path("report")});
  ASSERT_EQ(result.end.exit_code, 0) << result.output;
  EXPECT_THAT(result.output, AllOf(HasSubstr("crowd, mask"), HasSubstr("plain, nomasks")));
  const std::string text = test::content_of(path("report") + "/methods.md");
  EXPECT_THAT(text, AllOf(HasSubstr("| sequence | mask | full |"), HasSubstr("| late3 | nomasks |"),
                          Not(HasSubstr("failed"))));
  const auto json = nlohmann::json::parse(test::content_of(path("report") + "/methods.json"));
  ASSERT_EQ(json["sequences"].size(), 2U);
  const auto& methods = json["sequences"][0]["methods"];
  ASSERT_EQ(methods.size(), 2U);
  EXPECT_EQ(methods[0]["name"], "mask");
  EXPECT_EQ(methods[0]["frames"], 6);
  EXPECT_GT(methods[0]["verdicts"]["total"]["recall"], 0.9);
  EXPECT_GT(methods[0]["tracking_p50_ms"], 0.0);
  EXPECT_EQ(json["sequences"][0]["variants"].size(), 2U);
  EXPECT_TRUE(json["sequences"][1]["methods"][0]["verdicts"].is_null());
}

TEST_F(EvalDynamic, ReportNamesTheSequenceThatFailsAndGoesOn) {
  const ProgramResult result = tsgctl({"report", "methods", path("absent"), crowd(), "--methods",
                                       "mask", "--frames", "3", "--out", path("half")});
  EXPECT_EQ(result.end.exit_code, code(ExitCode::kFailure)) << result.output;
  EXPECT_THAT(result.output, HasSubstr("failed runs: 1; the first: absent, mask: there is no"));
  const std::string text = test::content_of(path("half") + "/methods.md");
  EXPECT_THAT(text, AllOf(HasSubstr("| absent | failed |"), HasSubstr("| crowd | mask | ")));
}

TEST_F(EvalDynamic, ReportRefusesWhatThereIsNot) {
  const ProgramResult method = tsgctl({"report", "methods", crowd(), "--methods", "magic"});
  EXPECT_EQ(method.end.exit_code, code(ExitCode::kUsage)) << method.output;
  const ProgramResult variant =
      tsgctl({"report", "methods", crowd(), "--variants", "late2", "--out", path("none")});
  EXPECT_EQ(variant.end.exit_code, code(ExitCode::kUsage)) << variant.output;
  EXPECT_THAT(variant.output, HasSubstr("choose among late1"));
}

}  // namespace
}  // namespace tsg
