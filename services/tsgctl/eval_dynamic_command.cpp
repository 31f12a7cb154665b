#include "services/tsgctl/eval_dynamic_command.hpp"

#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>
#include <string>

#include "common/core/atomic_file.hpp"
#include "common/core/time.hpp"
#include "services/tsgctl/dynamic/dynamic_run.hpp"
#include "services/tsgctl/dynamic/verdict_report.hpp"
#include "services/tsgctl/run/progress.hpp"
#include "services/tsgctl/slam_options.hpp"

namespace tsg {
namespace {

constexpr const char* kEvalDynamicFooter = R"(
Runs tracking and mapping over a sequence with true masks (mask/ and instances.json, which
'tsgctl simulate' writes) and compares what became of each feature with what is true of it.

By the truth a feature is
  moving   where its pixel lies on an instance that moves in that frame
  still    on the background or on an instance that does not move
  at rest  on an instance of a dynamic class, like a person, that does not move for the moment:
           in neither figure, since it is right to remove it and no harm to keep it
  recall     removed features that move / all that move
  precision  removed features that move / all removed that move or are still
Features within --margin-px of a pixel for which the truth says something else are at an edge: the
figures are given without them and with them. A frame counts for median and worst, and an instance
as visible, from 5 features on.

--debug writes FOLDER/NNNNNN.png: features kept (green), removed (red), removed though their class
is static (magenta), off their epipolar line (ring); outlines of the masks; boxes of the instances
that are followed with class, id and probability that they move.

Examples:
  tsgctl eval dynamic data/moved_chair
  tsgctl eval dynamic data/moved_chair --method tsg --json
  tsgctl eval dynamic data/moved_chair --mask-fault late_frames=6 --csv frames.csv
  tsgctl eval dynamic data/moved_chair --debug pictures --debug-every 30
Ends with 0 when the sequence was run to its end, whatever the figures; 66 where there is no truth to
compare with; other codes: docs/exit-codes.md.)";

struct EvalDynamicArguments {
  DynamicOptions options;
  SlamOptions slam;
  MaskArguments masks;
  bool json = false;
  std::filesystem::path csv;
};

InstanceTruth open_truth(const std::filesystem::path& folder) {
  // A folder that is not there is told as such, not by the first file that is missing in it.
  (void)value_or_throw(open_tum_folder(folder));
  auto truth = InstanceTruth::open(folder);
  if (truth) return std::move(*truth);
  if (truth.error().code != ExitCode::kMissingInput) throw FatalError(truth.error());
  throw FatalError(ExitCode::kMissingInput,
                   "nothing tells what is true of the features: " + truth.error().message +
                       "; 'tsgctl simulate SCENE --out DIR' makes one");
}

/// Which masks come, in words.
std::string text_of(const MaskOptions& masks) {
  if (!masks.use) return "no masks";
  return masks.faults.any() ? "masks with " + to_text(masks.faults) : "true masks";
}

DynamicRun run_with_progress(const DynamicOptions& options, const InstanceTruth& truth) {
  Progress progress;
  const std::int64_t start_ns = monotonic_ns();
  ProgressState state{0, 0, "running"};
  DynamicRun run = run_dynamic(options, &truth, [&](std::uint64_t done, std::uint64_t total) {
    state = {done, total, "running", to_seconds(monotonic_ns() - start_ns)};
    progress.update(state);
  });
  progress.finish(state);
  return run;
}

void run(EvalDynamicArguments& arguments) {
  DynamicOptions& options = arguments.options;
  VerdictReport report;
  options.bench.run.slam = arguments.slam.load();
  options.bench.run.masks = arguments.masks.load();
  report.masks = text_of(options.bench.run.masks);
  const InstanceTruth truth = open_truth(options.bench.folder);
  prepare(options.debug);
  if (!arguments.csv.empty())
    throw_on_error(write_file_atomically(arguments.csv, to_csv(std::vector<FrameScore>{})));
  DynamicRun result = run_with_progress(options, truth);
  report.sequence = result.bench.sequence;
  report.method = name_of(options.bench.run.slam.dynamic_filter.method);
  report.margin_px = options.margin_px;
  report.frames_lost = result.frames_lost();
  report.accuracy = result.accuracy;
  report.scores = std::move(result.scores);
  if (!arguments.csv.empty()) {
    throw_on_error(write_file_atomically(arguments.csv, to_csv(report.scores)));
  }
  std::cout << (arguments.json ? to_json(report).dump(2) + "\n" : to_text(report));
}

void describe(CLI::App& command, EvalDynamicArguments& arguments) {
  DynamicOptions& options = arguments.options;
  command.add_option("DIR", options.bench.folder, "Sequence with true masks")->required();
  add_method_option(command, arguments.slam.method);
  command.add_option("--frames", options.bench.frames, "Only the first N (all)")
      ->type_name("N")
      ->check(CLI::Range(1, 10'000'000).description(""));
  add_mask_options(command, arguments.masks);
  command.add_option("--margin-px", options.margin_px, "How near to an edge features count apart")
      ->type_name("PX")
      ->check(CLI::Range(0, 100).description(""))
      ->capture_default_str();
  command.add_flag("--json", arguments.json, "Write JSON instead of tables");
  command.add_option("--csv", arguments.csv, "Write the figures of each frame")
      ->type_name("FILE.csv");
  command.add_option("--debug", options.debug.folder, "Draw what was judged; made if not there")
      ->type_name("FOLDER");
  command.add_option("--debug-every", options.debug.every_frames, "A picture every N frames")
      ->type_name("N")
      ->check(CLI::Range(1, 10'000'000).description(""))
      ->capture_default_str();
  add_slam_options(command, arguments.slam);
  command.footer(kEvalDynamicFooter);
}

}  // namespace

void add_eval_dynamic_command(CLI::App& eval) {
  CLI::App& command = *eval.add_subcommand(
      "dynamic", "Verdicts on features against what moves by the truth: recall, precision");
  const auto arguments = std::make_shared<EvalDynamicArguments>();
  describe(command, *arguments);
  command.callback([arguments] { run(*arguments); });
}

}  // namespace tsg
