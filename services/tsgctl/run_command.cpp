#include "services/tsgctl/run_command.hpp"

#include <filesystem>
#include <functional>
#include <iostream>
#include <memory>
#include <string>

#include "common/app/config_file.hpp"
#include "common/app/shipped_files.hpp"
#include "common/app/stop_on_signal.hpp"
#include "common/core/atomic_file.hpp"
#include "common/core/time.hpp"
#include "common/dataset/evaluation.hpp"
#include "services/slam/config.hpp"
#include "services/tsgctl/bus_options.hpp"
#include "services/tsgctl/dynamic/dynamic_run.hpp"
#include "services/tsgctl/lib/run_summary.hpp"
#include "services/tsgctl/map/map_picture.hpp"
#include "services/tsgctl/plot.hpp"
#include "services/tsgctl/run/progress.hpp"
#include "services/tsgctl/run/run_session.hpp"
#include "services/tsgctl/slam_options.hpp"

namespace tsg {
namespace {

/// What stands on the command line.
struct RunArguments {
  RunOptions options;
  BusOptions bus;
  std::string pace = "realtime";
  std::string method;        ///< of --method; empty where it is not given
  std::string segmentation;  ///< empty: what the input and --model suggest
  bool debug = false;
};

constexpr const char* kRunFooter = R"(
Without --segmentation: "model" where --model is given, "dataset" where the input has true masks
(mask/ and instances.json), else "off".

Writes trajectory.txt, trajectory_live.txt, keyframes.txt (TUM format), map.ot, map.bt, cloud.ply,
report.json, logs/ and pictures into OUT: map.png, and trajectory.png where there is ground truth;
debug/NNNNNN.png with --debug (docs/dynamic-features.md tells what they show).
Ctrl-C stops everything and keeps what there is.

Examples:
  tsgctl run --input data/walking_xyz --out out
  tsgctl run --input data/walking_xyz --out out --pace lockstep --segmentation dataset
  tsgctl run --input data/fr3_walking --out out --segmentation model --model yolov8n-seg.onnx
  tsgctl run --input data/desk --out out --model solov2.onnx --labels coco.txt
  tsgctl run --input data/walking_xyz --out out --method tsg
  tsgctl run --input data/moved_chair --out out --debug
  tsgctl run --input data/desk --out out --set slam.features.max_features=800
  tsgctl run --input data/morning --out out --save-map home.tsgmap
  tsgctl run --input data/evening --out out2 --load-map home.tsgmap --localisation-only
Ends with 0 when every process did its work; other codes: docs/exit-codes.md.)";

void describe(CLI::App& command, RunArguments& arguments) {
  RunOptions& options = arguments.options;
  command.add_option("--input", options.input, "Sequence in TUM RGB-D layout")
      ->required()
      ->type_name("DIR");
  command.add_option("--out", options.out, "Folder for the results; made if it is not there")
      ->required()
      ->type_name("DIR");
  command
      .add_option("--pace", arguments.pace,
                  "realtime: frames come at the pace of their stamps (default); lockstep: each "
                  "waits for the answer to the one before, deterministic")
      ->check(CLI::IsMember({"realtime", "lockstep"}).description(""))
      ->type_name("realtime|lockstep");
  command.add_option("--segmentation", arguments.segmentation, "Where masks come from")
      ->check(CLI::IsMember({"dataset", "model", "off"}).description(""))
      ->type_name("dataset|model|off");
  command
      .add_option("--model", options.model,
                  "Network for --segmentation model (the shipped one, which knows simulated "
                  "rooms only)")
      ->type_name("FILE.onnx");
  command
      .add_option("--labels", options.labels,
                  "Names of its classes, one on each line; default: those in FILE.onnx")
      ->type_name("FILE");
  command.add_option("--load-map", options.load_map, "Start in the map of this file")
      ->type_name("FILE");
  command.add_flag("--localisation-only", options.localisation_only,
                   "Find poses in that map, never change it");
  command.add_option("--save-map", options.save_map, "Save slam's map into this file at the end")
      ->type_name("FILE");
  add_method_option(command, arguments.method);
  command.add_flag("--debug", arguments.debug,
                   "Draw what was judged of features into OUT/debug, every 10th frame; takes the "
                   "time of another run in lockstep");
  add_bus_options(command, arguments.bus);
  command.footer(kRunFooter);
}

/// Told now rather than when the run is over and its map would be lost.
void check_map_folder(const std::filesystem::path& map) {
  if (map.empty()) return;
  if (std::filesystem::is_directory(std::filesystem::absolute(map).parent_path())) return;
  throw FatalError(ExitCode::kCannotWrite, "--save-map " + map.string() +
                                               ": there is no such folder; create it first or "
                                               "choose another one");
}

SegmentationSource segmentation_of(const RunArguments& arguments) {
  if (arguments.segmentation == "dataset") return SegmentationSource::kDataset;
  if (arguments.segmentation == "model") return SegmentationSource::kModel;
  if (arguments.segmentation == "off") return SegmentationSource::kOff;
  if (!arguments.options.model.empty()) return SegmentationSource::kModel;
  return has_true_masks(arguments.options.input) ? SegmentationSource::kDataset
                                                 : SegmentationSource::kOff;
}

/// Adds a picture to the files of the report. A run is as good without it, so that a failure, for
/// example a missing gnuplot, is only told.
void add_picture(const std::string& name,
                 const std::function<Expected<void>(const std::filesystem::path&)>& draw,
                 RunReport& report) {
  const std::filesystem::path path = std::filesystem::path(report.out) / name;
  if (const auto drawn = draw(path); !drawn) {
    std::cerr << "tsgctl: warning: " << name << " is not drawn: " << drawn.error().message << "\n";
    return;
  }
  report.files.push_back({name, std::filesystem::file_size(path)});
}

Expected<void> draw_trajectory(const Trajectory& truth,
                               const RunOptions& options,
                               const std::filesystem::path& png) {
  return read_trajectory(options.out / "trajectory.txt")
      .and_then([&](const Trajectory& estimate) { return absolute_error(truth, estimate); })
      .and_then([&](const AbsoluteError& error) {
        const std::string title = options.input.filename().string();
        return plot_trajectory({title, truth, error}, png);
      });
}

void draw_pictures(const Sequence& sequence, const RunOptions& options, RunReport& report) {
  if (sequence.ground_truth && report.accuracy) {
    add_picture(
        "trajectory.png",
        [&](const auto& png) { return draw_trajectory(*sequence.ground_truth, options, png); },
        report);
  }
  if (std::filesystem::exists(options.out / "map.ot")) {
    add_picture(
        "map.png", [&](const auto& png) { return draw_map(options.out / "map.ot", png); }, report);
  }
}

void check_debug(const RunArguments& arguments) {
  if (!arguments.debug || arguments.options.segmentation != SegmentationSource::kModel) return;
  throw FatalError(ExitCode::kUsage,
                   "--debug draws with the sequence's true masks or without any: use it with "
                   "--segmentation dataset or off");
}

/// What the services judge stays with them, so the core runs once more over the sequence.
void draw_verdicts(const RunArguments& arguments, const StopOnSignal& signals) {
  const RunOptions& run = arguments.options;
  DynamicOptions options;
  options.bench.folder = run.input;
  options.bench.run.slam =
      load_slam_config(run.config.empty() ? ConfigFile::from_overrides(run.overrides)
                                          : ConfigFile::load(run.config, run.overrides))
          .core;
  options.bench.run.masks.use = run.segmentation == SegmentationSource::kDataset;
  options.debug.folder = run.out / "debug";
  prepare(options.debug);
  Progress progress;
  progress.say("drawing what was judged into " + options.debug.folder.string());
  const std::int64_t start_ns = monotonic_ns();
  (void)run_dynamic(options, nullptr, [&](std::uint64_t done, std::uint64_t total) {
    if (signals.token().stop_requested()) {
      throw FatalError(ExitCode::kInterrupted, "stopped before all pictures were drawn");
    }
    progress.update({done, total, "drawing", to_seconds(monotonic_ns() - start_ns)});
  });
}

/// Writes report.json and adds it to the files of the report, for the summary.
Expected<void> write_report(RunReport& report) {
  const std::filesystem::path path = std::filesystem::path(report.out) / "report.json";
  const std::string text = to_json(report).dump(2) + "\n";
  if (auto written = write_file_atomically(path, text); !written) return written;
  report.files.push_back({"report.json", text.size()});
  return {};
}

void run(RunArguments& arguments) {
  RunOptions& options = arguments.options;
  options.config = arguments.bus.config;
  options.overrides = with_method(arguments.bus.overrides, arguments.method);
  options.pace = arguments.pace == "lockstep" ? Pace::kLockstep : Pace::kRealtime;
  options.segmentation = segmentation_of(arguments);
  if (arguments.segmentation == "model" && options.model.empty()) {
    options.model = value_or_throw(find_shipped_network());
  }
  throw_on_error(check_run_options(options));
  check_debug(arguments);
  check_map_folder(options.save_map);
  const StopOnSignal signals;
  const Sequence sequence = open_sequence(options);
  RunSession session(options, sequence, signals);
  RunOutcome outcome = session.run();
  draw_pictures(sequence, options, outcome.report);
  const Expected<void> written = write_report(outcome.report);
  if (outcome.report.tracking.answered > 0) std::cout << summary_text(outcome.report);
  // The failure that ended the run matters more than one at writing about it.
  if (outcome.failure) throw *outcome.failure;
  throw_on_error(written);
  if (arguments.debug) draw_verdicts(arguments, signals);
}

}  // namespace

void add_run_command(CLI::App& app) {
  CLI::App& command = *app.add_subcommand(
      "run", "Run the whole system on a recorded sequence: trajectory, map, report");
  const auto arguments = std::make_shared<RunArguments>();
  describe(command, *arguments);
  command.callback([arguments] { run(*arguments); });
}

}  // namespace tsg
