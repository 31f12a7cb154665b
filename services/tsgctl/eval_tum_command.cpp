#include "services/tsgctl/eval_tum_command.hpp"

#include <CLI/CLI.hpp>
#include <filesystem>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include "services/tsgctl/bus_options.hpp"
#include "services/tsgctl/tum/tum_evaluation.hpp"

namespace tsg {
namespace {

constexpr const char* kEvalTumFooter = R"(
Runs the whole system (as tsgctl run --pace lockstep) over sequences of the TUM RGB-D benchmark, plain
and with removal of dynamic features, and prints the paper's tables with the figures of this system.
NAME is like fr3/walking_xyz; without one, all sequences of the tables. deploy/fetch-tum downloads them.

The benchmark has no masks: removal by class needs a network (--model). Without one there is only the
plain run.

Examples:
  deploy/fetch-tum --all && tsgctl eval-tum --model yolov8n-seg.onnx
  tsgctl eval-tum --table 4 --model yolov8n-seg.onnx --json
  tsgctl eval-tum fr1/desk fr1/room --out results
Ends with 0 when all that was named was run, 66 where a sequence that was named is missing, or all are;
other codes: docs/exit-codes.md.)";

struct EvalTumArguments {
  TumOptions options;
  BusOptions bus;
  std::string table = "all";
  std::string segmentation;
  bool json = false;
};

SegmentationSource segmentation_of(const EvalTumArguments& arguments) {
  if (arguments.segmentation == "dataset") return SegmentationSource::kDataset;
  if (arguments.segmentation == "model") return SegmentationSource::kModel;
  const bool is_off = arguments.segmentation == "off" || arguments.options.model.empty();
  return is_off ? SegmentationSource::kOff : SegmentationSource::kModel;
}

/// What is wrong with the options, told before the first sequence and not once for each.
void check(const TumOptions& options) {
  throw_on_error(check_run_options({.input = {},
                                    .out = {},
                                    .pace = Pace::kLockstep,
                                    .segmentation = options.segmentation,
                                    .model = options.model,
                                    .config = options.config,
                                    .overrides = options.overrides}));
  if (options.segmentation != SegmentationSource::kModel) return;
  if (std::filesystem::exists(options.model)) return;
  throw FatalError(ExitCode::kMissingInput,
                   options.model.string() + ": no such file; --model needs a network in ONNX");
}

/// After the tables, which show what there is: the exit code for what there is not.
void report_what_is_left(const TumReport& report, const TumOptions& options) {
  if (!report.missing.empty() && (report.sequences.empty() || !options.names.empty())) {
    throw FatalError(ExitCode::kMissingInput, std::to_string(report.missing.size()) +
                                                  " sequences are not in " + options.data.string() +
                                                  "; fetch them: " + report.fetch_command);
  }
  for (const TumSequenceResult& result : report.sequences) {
    if (result.problem.empty()) continue;
    throw FatalError(ExitCode::kFailure, result.name + ": " + result.problem);
  }
}

void run(EvalTumArguments& arguments) {
  TumOptions& options = arguments.options;
  options.tables = {2, 3, 4, 5};
  if (arguments.table != "all") options.tables = {std::stoi(arguments.table)};
  options.segmentation = segmentation_of(arguments);
  options.config = arguments.bus.config;
  options.overrides = arguments.bus.overrides;
  check(options);
  const StopOnSignal signals;
  const TumReport report = evaluate_tum(options, signals);
  std::cout << (arguments.json ? to_json(report).dump(2) + "\n" : to_text(report)) << std::flush;
  report_what_is_left(report, options);
}

}  // namespace

void add_eval_tum_command(CLI::App& app) {
  CLI::App& command =
      *app.add_subcommand("eval-tum", "The paper's Tables 2 to 5, from the TUM RGB-D benchmark");
  const auto arguments = std::make_shared<EvalTumArguments>();
  TumOptions& options = arguments->options;
  options.data = default_tum_folder();
  options.out = "eval_tum";
  command.add_option("NAME", options.names,
                     "Sequences, like fr3/walking_xyz (those of the tables)");
  command.add_option("--data", options.data, "Folder that deploy/fetch-tum has filled")
      ->type_name("DIR")
      ->capture_default_str();
  command.add_option("--out", options.out, "Folder for the results of each run")
      ->type_name("DIR")
      ->capture_default_str();
  command.add_option("--table", arguments->table, "Only this table of the paper")
      ->check(CLI::IsMember({"2", "3", "4", "5", "all"}).description(""))
      ->type_name("2|3|4|5|all");
  command
      .add_option("--segmentation", arguments->segmentation,
                  "Where masks come from (model with --model, else off)")
      ->check(CLI::IsMember({"model", "dataset", "off"}).description(""))
      ->type_name("model|dataset|off");
  command.add_option("--model", options.model, "Network for --segmentation model")
      ->type_name("FILE.onnx");
  command.add_flag("--json", arguments->json, "Write JSON instead of tables");
  add_bus_options(command, arguments->bus);
  command.footer(kEvalTumFooter);
  command.callback([arguments] { run(*arguments); });
}

}  // namespace tsg
