#include "services/tsgctl/tum/tum_report.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace tsg {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

TumRun run_of(double rmse) {
  TumRun run{.frames = 800, .lost = 2, .accuracy = {}};
  run.accuracy.ate_m = {.count = 798, .rmse = rmse, .mean = 0.9 * rmse, .std_dev = 0.4 * rmse};
  run.accuracy.rpe_translation_m = {.count = 700, .rmse = 0.015};
  run.accuracy.rpe_rotation_deg = {.count = 700, .rmse = 0.5};
  run.accuracy.rpe_delta = "1 s";
  return run;
}

TumReport walking() {
  return {.tables = {4, 5},
          .segmentation = "model",
          .model = "m.onnx",
          .sequences = {{.name = "fr3/walking_xyz",
                         .plain = run_of(0.5),
                         .tsg = run_of(0.0125),
                         .problem = {}}},
          .missing = {"fr3/walking_static"},
          .fetch_command = "deploy/fetch-tum fr3/walking_static"};
}

TEST(TumReportText, PutsThisSystemBesideThePaper) {
  const std::string text = to_text(walking());
  EXPECT_THAT(text, HasSubstr("Table 4: people who walk\n"));
  EXPECT_THAT(text, HasSubstr("0.7123"));   // ORB-SLAM3's RMSE in the paper
  EXPECT_THAT(text, HasSubstr("0.0121!"));  // misprinted
  EXPECT_THAT(text, HasSubstr("0.0258 (fr3/walking_xyz)"));
  EXPECT_THAT(text, HasSubstr("0.5000   0.0125        97.50 %  98.25 %"));
  EXPECT_THAT(text, HasSubstr("798/800"));
  EXPECT_THAT(text, HasSubstr("RPE over 1 s\n"));
}

TEST(TumReportText, ComparesImprovementWithOtherSystems) {
  const std::string text = to_text(walking());
  EXPECT_THAT(text, HasSubstr("Table 5"));
  EXPECT_THAT(text, HasSubstr("97.30 %   98.21 %    95.54 %     98.39 %    98.30 %    97.50 %"));
}

TEST(TumReportText, NamesWhatIsMissingAndHowToGetIt) {
  EXPECT_THAT(to_text(walking()), HasSubstr("missing: fr3/walking_static\n  fetch them: "
                                            "deploy/fetch-tum fr3/walking_static\n"));
}

TEST(TumReportText, SaysThatNothingIsRemovedWithoutMasks) {
  TumReport report = walking();
  EXPECT_THAT(to_text(report), Not(HasSubstr("There were no masks")));
  report.segmentation = "off";
  report.sequences[0].tsg.reset();
  EXPECT_THAT(to_text(report), HasSubstr("There were no masks"));
}

TEST(TumReportText, ShowsSequencesThatThePaperDoesNotHave) {
  TumReport report = walking();
  report.tables = {2};
  report.sequences[0].name = "fr1/xyz";
  report.sequences[0].tsg.reset();
  report.sequences[0].problem = "slam died";
  const std::string text = to_text(report);
  EXPECT_THAT(text, HasSubstr("fr1/xyz"));
  EXPECT_THAT(text, HasSubstr("Table 2: static scenes\n  none of its sequences was run\n"));
  EXPECT_THAT(text, HasSubstr("problem: slam died\n"));
}

TEST(TumReportJson, HoldsBothRunsThePaperAndWhatIsMissing) {
  const nlohmann::json json = to_json(walking());
  const nlohmann::json& entry = json["sequences"][0];
  EXPECT_EQ(entry["table"], 4);
  EXPECT_DOUBLE_EQ(entry["tsg"]["ate_m"]["rmse"], 0.0125);
  EXPECT_DOUBLE_EQ(entry["paper"]["orb_slam3"]["ate_m"]["rmse"], 0.7123);
  EXPECT_NEAR(entry["ate_improvement"]["rmse"], 0.975, 1e-12);
  EXPECT_TRUE(entry["problem"].is_null());
  EXPECT_EQ(json["missing"][0], "fr3/walking_static");
}

}  // namespace
}  // namespace tsg
