#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <opencv2/imgcodecs.hpp>
#include <sstream>
#include <string>

#include "services/tsgctl/eval_command.hpp"
#include "services/tsgctl/eval_report.hpp"
#include "services/tsgctl/plot.hpp"
#include "tests/support/temp_folder.hpp"

namespace tsg {
namespace {

using test::TempFolder;
using ::testing::HasSubstr;
using ::testing::Not;

Summary make_summary(double rmse) {
  Summary summary;
  summary.count = 786;
  summary.rmse = rmse;
  summary.mean = rmse / 2.0;
  return summary;
}

/// A path in x and z; y hardly changes.
Trajectory make_path(double noise_m) {
  Trajectory path;
  for (int i = 0; i < 90; ++i) {
    const double t = 0.1 * i;
    const Eigen::Vector3d p(std::cos(t) + noise_m * std::sin(37.0 * t),
                            0.01 * std::sin(t) + noise_m * std::cos(23.0 * t), std::sin(2.0 * t));
    path.push_back({i * 33'333'333LL, SE3(Eigen::Quaterniond::Identity(), p)});
  }
  return path;
}

/// Runs "tsgctl eval ..." and gives what it writes.
std::string run_eval(const std::string& arguments) {
  CLI::App app;
  add_eval_command(app);
  testing::internal::CaptureStdout();
  try {
    app.parse("eval " + arguments);
  } catch (...) {
    testing::internal::GetCapturedStdout();
    throw;
  }
  return testing::internal::GetCapturedStdout();
}

class EvalCommand : public ::testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(write_trajectory(folder_ / "groundtruth.txt", make_path(0.0)));
    ASSERT_TRUE(write_trajectory(folder_ / "est.txt", make_path(0.01)));
    ASSERT_TRUE(write_trajectory(folder_ / "worse.txt", make_path(0.1)));
  }
  [[nodiscard]] std::string path(const std::string& name) const {
    return (folder_ / name).string();
  }

  TempFolder folder_;
};

TEST(EvalReport, TextNamesPairsFiguresAndImprovement) {
  AteReport report{{"gt", "est", "ref"}, 800, make_summary(0.0191), make_summary(0.0212)};
  EXPECT_EQ(to_text(report),
            "est against gt\n"
            "reference: ref\n"
            "786 of 800 poses matched within 20 ms, aligned rigidly (no scale)\n\n"
            "               rmse      mean      median    std       min       max\n"
            "ATE [m]        0.019100  0.009550  0.000000  0.000000  0.000000  0.000000\n"
            "  reference    0.021200  0.010600  0.000000  0.000000  0.000000  0.000000\n"
            "  improvement  9.91 %    9.91 %    -         -         -         -\n");
}

TEST_F(EvalCommand, AteWritesTheSameFiguresAsTextAndJson) {
  const std::string text = run_eval("ate " + path("groundtruth.txt") + " " + path("est.txt"));
  const auto json = nlohmann::json::parse(
      run_eval("ate " + path("groundtruth.txt") + " " + path("est.txt") + " --json"));
  EXPECT_EQ(json["metric"], "ate");
  EXPECT_EQ(json["pairs"], 90);
  EXPECT_EQ(json["poses"], 90);
  const double rmse = json["translation_m"]["rmse"];
  EXPECT_GT(rmse, 0.005);
  EXPECT_LT(rmse, 0.015);
  EXPECT_THAT(text, HasSubstr(std::to_string(rmse)));
}

TEST_F(EvalCommand, TakesAFolderAsGroundTruthAndAReference) {
  const auto json =
      nlohmann::json::parse(run_eval("ate " + folder_.path().string() + " " + path("est.txt") +
                                     " --json --reference " + path("worse.txt")));
  EXPECT_GT(json["improvement"]["rmse"], 0.85);
  EXPECT_LT(json["improvement"]["rmse"], 0.95);
}

TEST_F(EvalCommand, RpeKnowsFramesAndSeconds) {
  const std::string files = path("groundtruth.txt") + " " + path("est.txt") + " --json";
  const auto seconds = nlohmann::json::parse(run_eval("rpe " + files));
  const auto frames =
      nlohmann::json::parse(run_eval("rpe " + files + " --delta 30 --delta-unit frames"));
  EXPECT_EQ(seconds["delta_unit"], "seconds");
  EXPECT_EQ(frames["delta_unit"], "frames");
  EXPECT_EQ(frames["pairs"], 60);
  EXPECT_EQ(seconds["translation_m"], frames["translation_m"]);
}

TEST_F(EvalCommand, FailuresKeepTheirCode) {
  try {
    run_eval("ate " + path("groundtruth.txt") + " " + path("none.txt"));
    FAIL() << "an absent estimate was evaluated";
  } catch (const FatalError& error) {
    EXPECT_EQ(error.code(), ExitCode::kMissingInput);
  }
  EXPECT_THROW(
      run_eval("rpe " + path("groundtruth.txt") + " " + path("est.txt") + " --delta-unit metres"),
      CLI::ParseError);
}

TEST_F(EvalCommand, PlotIsAPictureOfTheTrajectories) {
  run_eval("ate " + path("groundtruth.txt") + " " + path("est.txt") + " --plot " + path("p.png"));
  const cv::Mat picture = cv::imread(path("p.png"));
  ASSERT_EQ(picture.size(), cv::Size(1200, 900));
  cv::Mat grey;
  cv::extractChannel(picture, grey, 0);
  EXPECT_GT(cv::countNonZero(grey < 250), 5000);
}

TEST_F(EvalCommand, PlotThatCannotBeWrittenIsAnError) {
  try {
    run_eval("ate " + path("groundtruth.txt") + " " + path("est.txt") + " --plot " +
             path("absent/p.png"));
    FAIL() << "a plot was written into a folder that is not there";
  } catch (const FatalError& error) {
    EXPECT_EQ(error.code(), ExitCode::kCannotWrite);
    EXPECT_THAT(error.what(), HasSubstr("absent/p.png"));
  }
}

TEST(PlotScript, DrawsTheTwoAxesOfLargestExtent) {
  const auto error = absolute_error(make_path(0.0), make_path(0.01));
  ASSERT_TRUE(error);
  const std::string script = plot_script({"it's a room", make_path(0.0), *error}, "a.png");
  EXPECT_THAT(script, HasSubstr("set xlabel 'x [m]'"));
  EXPECT_THAT(script, HasSubstr("set ylabel 'z [m]'"));
  EXPECT_THAT(script, HasSubstr("set size ratio -1"));
  EXPECT_THAT(script, HasSubstr("'it''s a room'"));
}

/// The size of a range that a script sets, e.g. "xrange [1:3]".
double size_of(const std::string& range, const std::string& script) {
  std::istringstream text(script.substr(script.find("set " + range + " [") + range.size() + 6));
  double low = 0.0;
  double high = 0.0;
  char colon = 0;
  text >> low >> colon >> high;
  return high - low;
}

TEST(PlotScript, GivesAStraightPathMoreThanAStrip) {
  Trajectory straight;
  for (int i = 0; i < 60; ++i) {
    straight.push_back(
        {i * 33'000'000LL, SE3(Eigen::Quaterniond::Identity(), {0.01 * i, 0.0, 0.0})});
  }
  const auto error = absolute_error(straight, straight);
  ASSERT_TRUE(error);
  const std::string script = plot_script({"", straight, *error}, "a.png");
  EXPECT_GE(size_of("xrange", script), 0.59);
  EXPECT_GE(size_of("yrange", script), 0.5 * size_of("xrange", script));
}

TEST(PlotScript, BreaksTheLineWhereTrackingWasLost) {
  Trajectory estimate = make_path(0.01);
  const auto whole = absolute_error(make_path(0.0), estimate);
  estimate.erase(estimate.begin() + 30, estimate.begin() + 60);
  const auto broken = absolute_error(make_path(0.0), estimate);
  ASSERT_TRUE(whole && broken);
  EXPECT_THAT(plot_script({"", make_path(0.0), *whole}, "a.png"), Not(HasSubstr("\n\n")));
  EXPECT_THAT(plot_script({"", make_path(0.0), *broken}, "a.png"), HasSubstr("\n\n"));
}

TEST(PlotTrajectory, SaysHowToGetGnuplotWhereItIsAbsent) {
  const auto error = absolute_error(make_path(0.0), make_path(0.01));
  ASSERT_TRUE(error);
  const TempFolder folder;
  const std::string path = std::getenv("PATH");
  ::setenv("PATH", folder.path().c_str(), 1);
  const auto result = plot_trajectory({"", make_path(0.0), *error}, folder / "p.png");
  ::setenv("PATH", path.c_str(), 1);
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, ExitCode::kUnavailable);
  EXPECT_THAT(result.error().message, HasSubstr("apt-get install gnuplot-nox"));
}

}  // namespace
}  // namespace tsg
