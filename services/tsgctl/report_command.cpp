#include "services/tsgctl/report_command.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <functional>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include "common/core/atomic_file.hpp"
#include "common/core/time.hpp"
#include "services/tsgctl/dynamic/methods_run.hpp"
#include "services/tsgctl/run/progress.hpp"
#include "services/tsgctl/slam_options.hpp"

namespace tsg {
namespace {

constexpr const char* kReportFooter = R"(
Runs the core with each method, and method full with masks that are late, seldom or not there, over
each sequence, and writes FOLDER/methods.md and FOLDER/methods.json: ATE and RPE by sequence and
method, improvement over none (eq. 12), recall and precision of the verdicts and the features left
(Table 1) where the sequence has true masks, CPU time of tracking. docs/dynamic-features.md tells
what the figures mean.

Examples:
  tsgctl report methods data/walking_xyz data/moved_chair data/crowd
  tsgctl report methods data/* --methods none,tsg,full --variants late6,nomasks --out report
  tsgctl report methods data/moved_chair --variants off
Ends with 1 where a run failed; the others are in the report all the same.)";

constexpr const char* kAll = "all";
constexpr const char* kOff = "off";

struct ReportArguments {
  MethodsOptions options;
  SlamOptions slam;
  std::vector<std::string> methods{kDynamicMethodNames.begin(), kDynamicMethodNames.end()};
  std::vector<std::string> variants;
  std::filesystem::path out = "methods_report";
};

std::vector<const RunVariant*> variants_of(const std::vector<std::string>& names) {
  std::vector<const RunVariant*> variants;
  if (names == std::vector<std::string>{kOff}) return variants;
  if (names == std::vector<std::string>{kAll}) {
    for (const RunVariant& variant : run_variants()) variants.push_back(&variant);
    return variants;
  }
  for (const std::string& name : names) variants.push_back(value_or_throw(find_variant(name)));
  return variants;
}

std::string joined(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ",") + name;
  return text;
}

/// What makes the same report again.
std::string command_of(const ReportArguments& arguments) {
  std::string text = "tsgctl report methods";
  for (const auto& folder : arguments.options.sequences) text += " " + folder.string();
  text += " --methods " + joined(arguments.methods) + " --variants " + joined(arguments.variants);
  if (arguments.options.frames > 0) text += " --frames " + std::to_string(arguments.options.frames);
  if (!arguments.slam.config.empty()) text += " --config " + arguments.slam.config;
  for (const std::string& setting : arguments.slam.overrides) text += " --set " + setting;
  return text;
}

/// A line for each run, and how far it is.
class RunProgress {
 public:
  void operator()(const MethodsProgress& now) {
    if (now.run != run_) {
      progress_.say(now.run);
      run_ = now.run;
      start_ns_ = monotonic_ns();
    }
    if (now.total == 0) return;
    progress_.update({now.done, now.total, "running", to_seconds(monotonic_ns() - start_ns_)});
  }

 private:
  Progress progress_;
  std::string run_;
  std::int64_t start_ns_ = 0;
};

void write(const MethodsReport& report, const std::filesystem::path& out) {
  throw_on_error(write_file_atomically(out / "methods.md", to_markdown(report)));
  throw_on_error(write_file_atomically(out / "methods.json", to_json(report).dump(2) + "\n"));
}

void run(ReportArguments& arguments) {
  MethodsOptions& options = arguments.options;
  options.slam = arguments.slam.load();
  options.methods.clear();
  for (const std::string& name : arguments.methods) options.methods.push_back(*method_named(name));
  if (arguments.variants.empty()) {
    const bool has_full = std::ranges::count(options.methods, DynamicMethod::kFull) > 0;
    arguments.variants = {has_full ? kAll : kOff};
  }
  options.variants = variants_of(arguments.variants);
  throw_on_error(make_folder(arguments.out));
  RunProgress progress;
  // After each sequence, as it may take long and be stopped before its end.
  const MethodsReport report =
      run_methods(options, command_of(arguments),
                  {.on_progress = std::ref(progress),
                   .on_sequence = [&](const MethodsReport& now) { write(now, arguments.out); }});
  std::cout << to_markdown(report);
  const std::vector<std::string> problems = report.problems();
  if (problems.empty()) return;
  throw FatalError(ExitCode::kFailure, "failed runs: " + std::to_string(problems.size()) +
                                           "; the first: " + problems.front() + "; all are in " +
                                           (arguments.out / "methods.md").string());
}

}  // namespace

void add_report_command(CLI::App& app) {
  CLI::App* report = app.add_subcommand("report", "Tables that rerun everything they show");
  report->require_subcommand(1);
  CLI::App& command = *report->add_subcommand(
      "methods", "All methods of dynamic feature removal on the given sequences");
  const auto arguments = std::make_shared<ReportArguments>();
  command.add_option("DIR", arguments->options.sequences, "Sequences in TUM RGB-D layout")
      ->required();
  command.add_option("--methods", arguments->methods, "Which, separated by commas (all)")
      ->delimiter(',')
      ->check(CLI::IsMember(
                  std::vector<std::string>(kDynamicMethodNames.begin(), kDynamicMethodNames.end()))
                  .description(""))
      ->type_name("none,mask,epipolar,tsg,full");
  command
      .add_option(
          "--variants", arguments->variants,
          "Imperfect masks for method full, separated by commas; all (default with full) or off")
      ->delimiter(',')
      ->type_name("late1,late3,...|all|off");
  command.add_option("--frames", arguments->options.frames, "Only the first N of each (all)")
      ->type_name("N")
      ->check(CLI::Range(1, 10'000'000).description(""));
  command.add_option("--out", arguments->out, "Folder for the report; made if it is not there")
      ->type_name("FOLDER")
      ->capture_default_str();
  add_slam_options(command, arguments->slam);
  command.footer(kReportFooter);
  command.callback([arguments] { run(*arguments); });
}

}  // namespace tsg
