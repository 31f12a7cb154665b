#include "services/tsgctl/dynamic/methods_report.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace tsg {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

MethodRun run(const std::string& name, double ate_m, double rpe_m, std::size_t lost = 0) {
  MethodRun result{.name = name, .problem = {}};
  result.frames = 280;
  result.frames_lost = lost;
  result.tracking_p50_ms = 7.94;
  result.accuracy = TrajectoryAccuracy{};
  result.accuracy->ate_m.rmse = ate_m;
  result.accuracy->rpe_translation_m.rmse = rpe_m;
  result.accuracy->rpe_delta = "1 s";
  return result;
}

VerdictSummary verdicts() {
  VerdictSummary summary{.frames = 10};
  summary.total.of(TrueState::kMoving) = {90, 10};
  summary.total.of(TrueState::kStill) = {10, 890};
  summary.kinds[static_cast<std::size_t>(FeatureKind::kDynamicClasses)] = {90, 15};
  return summary;
}

MethodsReport example_runs() {
  SequenceRuns chair{
      .name = "moved_chair", .folder = "data/moved_chair", .methods = {}, .variants = {}};
  chair.methods = {run("none", 0.4, 0.2), run("full", 0.004, 0.01)};
  chair.methods[1].verdicts = verdicts();
  chair.variants = {run("late6", 0.005, 0.011, 3)};
  SequenceRuns absent{.name = "absent", .folder = "data/absent", .methods = {}, .variants = {}};
  absent.methods = {{.name = "none", .problem = "there is no folder data/absent"}};
  return {.command = "tsgctl report methods data/moved_chair data/absent",
          .methods = {"none", "full"},
          .variants = {"late6"},
          .variant_texts = {"6 frames late"},
          .sequences = {chair, absent}};
}

TEST(MethodsReportMarkdown, HasATableForEachFigure) {
  const std::string text = to_markdown(example_runs());
  EXPECT_THAT(text, HasSubstr("    tsgctl report methods data/moved_chair data/absent\n"));
  EXPECT_THAT(text, HasSubstr("## ATE RMSE, m\n\n| sequence | none | full |\n| --- | --- | --- |\n"
                              "| moved_chair | 0.4000 | 0.0040 |\n| absent | failed | - |\n"));
  EXPECT_THAT(text, HasSubstr("| moved_chair | 0.2000 | 0.0100 |\n"));
  EXPECT_THAT(text, HasSubstr("| moved_chair | 0.0 % | 99.0 % |\n"));
  EXPECT_THAT(text, HasSubstr("| moved_chair | - | 0.900 / 0.900 |\n"));
}

TEST(MethodsReportMarkdown, ShowsWhatImperfectMasksCost) {
  const std::string text = to_markdown(example_runs());
  EXPECT_THAT(text, HasSubstr("* `late6`: masks 6 frames late\n"));
  EXPECT_THAT(text, HasSubstr("| moved_chair | 0.0050 (3 lost), × 1.25 |\n"));
  MethodsReport without = example_runs();
  without.variants.clear();
  EXPECT_THAT(to_markdown(without), Not(HasSubstr("imperfect masks")));
}

TEST(MethodsReportMarkdown, HasEveryRunWithAllItsFigures) {
  const std::string text = to_markdown(example_runs());
  EXPECT_THAT(text, HasSubstr("| moved_chair | full | 0.0040 | 99.0 % | 0.0100 | 95.0 % | 0/280 | "
                              "7.9 | 0.900 | 0.900 |\n"));
  EXPECT_THAT(text, HasSubstr("| absent | none | failed: there is no folder data/absent |"));
}

TEST(MethodsReportMarkdown, CountsFeaturesLeftPerFrameWhereTheTruthIsKnown) {
  EXPECT_THAT(to_markdown(example_runs()), HasSubstr("| moved_chair | full | 0.0 | 1.5 | 0.0 |"));
  MethodsReport real = example_runs();
  real.sequences[0].methods[1].verdicts.reset();
  EXPECT_THAT(to_markdown(real), HasSubstr("No sequence tells what moves in it.\n"));
}

TEST(MethodsReportMarkdown, MarksARelativeErrorOverAnotherTime) {
  MethodsReport brief = example_runs();
  brief.sequences[0].methods[0].accuracy->rpe_delta = "1 frame";
  EXPECT_THAT(to_markdown(brief), HasSubstr("| moved_chair | 0.2000 over 1 frame | 0.0100 |\n"));
}

TEST(MethodsReport, ImprovementNeedsARunWithoutRemoval) {
  MethodsReport alone = example_runs();
  SequenceRuns& chair = alone.sequences[0];
  const MethodRun full = chair.methods[1];
  EXPECT_DOUBLE_EQ(*ate_improvement(chair, full), 0.99);
  EXPECT_DOUBLE_EQ(*rpe_improvement(chair, full), 0.95);
  chair.methods.erase(chair.methods.begin());
  EXPECT_FALSE(ate_improvement(chair, full));
}

TEST(MethodsReport, NamesWhatFailed) {
  EXPECT_THAT(example_runs().problems(),
              ElementsAre("absent, none: there is no folder data/absent"));
}

TEST(MethodsReportJson, HasEveryRun) {
  const nlohmann::json json = to_json(example_runs());
  const auto& chair = json["sequences"][0];
  EXPECT_EQ(chair["folder"], "data/moved_chair");
  EXPECT_DOUBLE_EQ(chair["methods"][1]["ate_rmse_m"], 0.004);
  EXPECT_DOUBLE_EQ(chair["methods"][1]["verdicts"]["total"]["recall"], 0.9);
  EXPECT_TRUE(chair["methods"][0]["verdicts"].is_null());
  EXPECT_EQ(chair["variants"][0]["frames_lost"], 3);
  EXPECT_EQ(json["sequences"][1]["methods"][0]["problem"], "there is no folder data/absent");
}

}  // namespace
}  // namespace tsg
