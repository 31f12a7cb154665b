#include "services/tsgctl/eval_command.hpp"

#include <CLI/CLI.hpp>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <map>
#include <memory>
#include <string>

#include "services/tsgctl/eval_report.hpp"
#include "services/tsgctl/plot.hpp"

namespace tsg {
namespace {

struct EvalOptions {
  EvalInput input;
  bool json = false;
  std::string plot;
  double delta = 1.0;
  DeltaUnit unit = DeltaUnit::kSeconds;
};

std::int64_t max_difference_ns(const EvalOptions& options) {
  return static_cast<std::int64_t>(std::llround(options.input.max_difference_s * 1e9));
}

template <typename Report>
void print(const Report& report, bool json) {
  std::cout << (json ? to_json(report).dump(2) + "\n" : to_text(report));
}

/// "walking_xyz" for .../walking_xyz and for .../walking_xyz/groundtruth.txt.
std::string sequence_name(const std::string& truth) {
  std::filesystem::path path = std::filesystem::path(truth).lexically_normal();
  if (!path.has_filename() || path.filename() == "groundtruth.txt") path = path.parent_path();
  return path.stem().string();
}

void draw(const EvalOptions& options, const Trajectory& truth, const AbsoluteError& error) {
  const TrajectoryPlot plot{sequence_name(options.input.truth), truth, error};
  throw_on_error(plot_trajectory(plot, options.plot));
}

void evaluate_ate(const EvalOptions& options) {
  const Trajectory truth = value_or_throw(read_ground_truth(options.input.truth));
  const Trajectory estimate = value_or_throw(read_trajectory(options.input.estimate));
  const AbsoluteError error =
      value_or_throw(absolute_error(truth, estimate, max_difference_ns(options)));
  AteReport report{options.input, estimate.size(), error.translation_m, std::nullopt};
  if (!options.input.reference.empty()) {
    const Trajectory reference = value_or_throw(read_trajectory(options.input.reference));
    report.reference_error_m =
        value_or_throw(absolute_error(truth, reference, max_difference_ns(options))).translation_m;
  }
  if (!options.plot.empty()) draw(options, truth, error);
  print(report, options.json);
}

void evaluate_rpe(const EvalOptions& options) {
  const RelativeErrorConfig config{options.delta, options.unit, max_difference_ns(options)};
  const Trajectory truth = value_or_throw(read_ground_truth(options.input.truth));
  const Trajectory estimate = value_or_throw(read_trajectory(options.input.estimate));
  RpeReport report{options.input, options.delta, options.unit,
                   value_or_throw(relative_error(truth, estimate, config)), std::nullopt};
  if (!options.input.reference.empty()) {
    const Trajectory reference = value_or_throw(read_trajectory(options.input.reference));
    report.reference_error = value_or_throw(relative_error(truth, reference, config));
  }
  if (!options.plot.empty()) {
    draw(options, truth, value_or_throw(absolute_error(truth, estimate, config.max_difference_ns)));
  }
  print(report, options.json);
}

void add_common_options(CLI::App& command, EvalOptions& options) {
  command
      .add_option("GT", options.input.truth,
                  "Ground truth: a trajectory file, or a TUM folder with groundtruth.txt")
      ->required();
  command.add_option("EST", options.input.estimate, "Estimate: a trajectory file in TUM format")
      ->required();
  command.add_option("--reference", options.input.reference,
                     "Another estimate: report the improvement over it (eq. 12)");
  command
      .add_option("--max-difference", options.input.max_difference_s,
                  "Most time between poses that are compared, in seconds")
      ->check(CLI::Range(0.0, 10.0))
      ->capture_default_str();
  command.add_option("--plot", options.plot,
                     "Draw the aligned estimate and the truth into this PNG file");
  command.add_flag("--json", options.json, "Write JSON instead of a table");
}

void add_ate(CLI::App& eval, const std::shared_ptr<EvalOptions>& options) {
  CLI::App* command =
      eval.add_subcommand("ate", "Absolute trajectory error after rigid alignment (eq. 10)");
  add_common_options(*command, *options);
  command->callback([options] { evaluate_ate(*options); });
}

void add_rpe(CLI::App& eval, const std::shared_ptr<EvalOptions>& options) {
  static const std::map<std::string, DeltaUnit> kUnits{{"frames", DeltaUnit::kFrames},
                                                       {"seconds", DeltaUnit::kSeconds}};
  CLI::App* command = eval.add_subcommand("rpe", "Relative pose error over a distance (eq. 11)");
  add_common_options(*command, *options);
  command->add_option("--delta", options->delta, "The distance in time (default 1)");
  command->add_option("--delta-unit", options->unit, "frames or seconds (default)")
      ->transform(CLI::CheckedTransformer(kUnits));
  command->callback([options] { evaluate_rpe(*options); });
}

}  // namespace

CLI::App& add_eval_command(CLI::App& app) {
  CLI::App* eval = app.add_subcommand("eval", "Errors against the truth: trajectories, verdicts");
  eval->require_subcommand(1);
  const auto options = std::make_shared<EvalOptions>();  // lives as long as the callbacks
  add_ate(*eval, options);
  add_rpe(*eval, options);
  return *eval;
}

}  // namespace tsg
