#include "services/tsgctl/bench_command.hpp"

#include <CLI/CLI.hpp>
#include <filesystem>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include "common/core/atomic_file.hpp"
#include "common/core/time.hpp"
#include "common/dataset/trajectory.hpp"
#include "services/tsgctl/bench/bench_slam.hpp"
#include "services/tsgctl/bench/scale_plot.hpp"
#include "services/tsgctl/run/progress.hpp"
#include "services/tsgctl/slam_options.hpp"

namespace tsg {
namespace {

constexpr const char* kBenchFooter = R"(
Runs tracking and mapping in turn over a sequence in TUM RGB-D layout, in one thread and without the
bus, and tells what that costs in CPU time. Reading images is not in the times. OpenCV's own threads
are switched off, so that the thread's CPU time is all there is.

Examples:
  tsgctl bench slam data/static_room
  tsgctl bench slam data/static_room --json --series frames.csv --out trajectory.txt
  tsgctl bench slam data/walking_xyz --no-masks --set slam.features.max_features=800
  tsgctl bench slam data/walking_xyz --mask-fault late_frames=6 --mask-fault shrink_px=10
  tsgctl bench slam data/walking_xyz --method tsg
  tsgctl bench slam data/scale_round --laps 20 --plot scale.png
Ends with 0 when the sequence was run to its end; other codes: docs/exit-codes.md.)";

struct BenchArguments {
  BenchOptions options;
  SlamOptions slam;
  MaskArguments masks;
  bool json = false;
  std::filesystem::path out;
  std::filesystem::path series;
  std::filesystem::path plot;
};

/// Before a run that may take long: whether its results can be put where they shall go.
void check_outputs(const BenchArguments& arguments) {
  for (const std::filesystem::path& file : {arguments.out, arguments.series, arguments.plot}) {
    if (file.empty()) continue;
    const std::filesystem::path folder = std::filesystem::absolute(file).parent_path();
    if (std::filesystem::is_directory(folder)) continue;
    throw FatalError(ExitCode::kCannotWrite,
                     file.string() + ": there is no folder " + folder.string() + "; make it first");
  }
}

void run(BenchArguments& arguments) {
  arguments.options.run.slam = arguments.slam.load();
  arguments.options.run.masks = arguments.masks.load();
  check_outputs(arguments);
  Progress progress;
  const std::int64_t start_ns = monotonic_ns();
  ProgressState state{0, 0, "running"};
  const BenchResult result =
      bench_slam(arguments.options, [&](std::uint64_t done, std::uint64_t total) {
        state = {done, total, "running", to_seconds(monotonic_ns() - start_ns)};
        progress.update(state);
      });
  progress.finish(state);
  if (!arguments.out.empty()) throw_on_error(write_trajectory(arguments.out, result.trajectory));
  if (!arguments.series.empty()) {
    throw_on_error(write_file_atomically(arguments.series, to_csv(result.report.frames)));
  }
  std::cout << (arguments.json ? to_json(result.report).dump(2) + "\n" : to_text(result.report));
  // Last, as it needs a program that may not be there.
  if (!arguments.plot.empty()) throw_on_error(plot_scale(result.report, arguments.plot));
}

}  // namespace

void add_bench_command(CLI::App& app) {
  CLI::App* bench = app.add_subcommand("bench", "CPU time of a library over a whole sequence");
  bench->require_subcommand(1);
  CLI::App& command = *bench->add_subcommand("slam", "Tracking and mapping, by stage");
  const auto arguments = std::make_shared<BenchArguments>();
  BenchOptions& options = arguments->options;
  command.add_option("DIR", options.folder, "Sequence in TUM RGB-D layout")->required();
  command.add_option("--frames", options.frames, "Only the first N (all)")
      ->type_name("N")
      ->check(CLI::Range(1, 10'000'000).description(""));
  command
      .add_option("--laps", options.run.laps, "Go through it N times; its path should be closed")
      ->type_name("N")
      ->check(CLI::Range(1, 100'000).description(""));
  add_mask_options(command, arguments->masks);
  command.add_flag("--json", arguments->json, "Write JSON instead of tables");
  command.add_option("--out", arguments->out, "Write the trajectory (TUM format)")
      ->type_name("FILE");
  command.add_option("--series", arguments->series, "Write the figures of each frame")
      ->type_name("FILE.csv");
  command.add_option("--plot", arguments->plot, "Draw time, memory and map size over the frames")
      ->type_name("FILE.png");
  add_method_option(command, arguments->slam.method);
  add_slam_options(command, arguments->slam);
  command.footer(kBenchFooter);
  command.callback([arguments] { run(*arguments); });
}

}  // namespace tsg
