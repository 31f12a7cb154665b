#include "services/tsgctl/eval_map_command.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "common/app/config_file.hpp"
#include "common/core/time.hpp"
#include "services/map_server/config.hpp"
#include "services/slam/config.hpp"
#include "services/tsgctl/map_eval/map_report.hpp"
#include "services/tsgctl/run/progress.hpp"

namespace tsg {
namespace {

constexpr const char* kEvalMapFooter = R"(
Builds the map of a sequence with true masks (mask/ and instances.json, which 'tsgctl simulate'
writes) by the code of the map server, in one thread and without a bus, and tells points and files
by size and what a keyframe costs. Where the sequence tells what is true of its space
(truth_objects.json and the .bt files beside it), it also tells
  traces of people     occupied leaves that people swept and that are free in truth: no surface
                       within a voxel of 5 cm
  off any true surface all occupied leaves that are free in truth
  objects              tags that stand for an object, those without one, objects without a tag.
                       An object counts once three keyframes show 0.2 % of the image of it where
                       it stands at the end; the size is off by the length of the difference of
                       both sizes, relative to the true one's.

--poses truth  true poses, every --every frames; what moves is told by instances.json
--poses slam   slam is run first: its keyframes, its poses as corrected at the end and its own
               verdicts on what moves. With true masks.
--trajectory   poses from a file, aligned with the truth
--method none  people and what moves go into the map like all else

Examples:
  tsgctl eval map data/walking
  tsgctl eval map data/walking --poses slam --json
  tsgctl eval map data/walking --method none
Ends with 0 when the map was built, whatever the figures; 66 where masks or poses are absent; other
codes: docs/exit-codes.md.)";

struct EvalMapArguments {
  MapEvalOptions options;
  std::string poses = "truth";
  std::string method = "full";
  std::string config;
  std::vector<std::string> overrides;
  bool json = false;
};

/// Sections of both services that run here.
void load_config(EvalMapArguments& arguments) {
  for (const std::string& setting : arguments.overrides) {
    if (setting.starts_with("map_server.") || setting.starts_with("slam.")) continue;
    throw FatalError(ExitCode::kUsage, "--set " + setting +
                                           ": only map_server and slam run here; give one of "
                                           "their keys, as map_server.resolution_m=0.1");
  }
  const ConfigFile file = arguments.config.empty()
                              ? ConfigFile::from_overrides(arguments.overrides)
                              : ConfigFile::load(arguments.config, arguments.overrides);
  arguments.options.map = load_map_server_config(file).map;
  arguments.options.sequence.slam = load_slam_config(file).core;
}

PoseSource pose_source(const EvalMapArguments& arguments) {
  const bool has_file = !arguments.options.sequence.trajectory.empty();
  if (has_file && arguments.poses == "slam") {
    throw FatalError(ExitCode::kUsage, "--trajectory and --poses slam: give one of them");
  }
  if (has_file) return PoseSource::kFile;
  return arguments.poses == "slam" ? PoseSource::kSlam : PoseSource::kTruth;
}

void run(EvalMapArguments& arguments) {
  load_config(arguments);
  arguments.options.sequence.poses = pose_source(arguments);
  arguments.options.exclude = arguments.method == "full";
  Progress progress;
  const std::int64_t start_ns = monotonic_ns();
  ProgressState state{0, 0, "reading"};
  const MapEvalReport report =
      evaluate_map(arguments.options, [&](const char* what, std::size_t done, std::size_t total) {
        state = {done, total, what, to_seconds(monotonic_ns() - start_ns)};
        progress.update(state);
      });
  progress.finish(state);
  std::cout << (arguments.json ? to_json(report).dump(2) + "\n" : to_text(report));
}

void describe(CLI::App& command, EvalMapArguments& arguments) {
  MapSequenceOptions& sequence = arguments.options.sequence;
  command.add_option("DIR", sequence.folder, "Sequence with true masks")->required();
  command.add_option("--poses", arguments.poses, "Where poses and keyframes come from")
      ->check(CLI::IsMember({"truth", "slam"}).description(""))
      ->type_name("truth|slam")
      ->capture_default_str();
  command.add_option("--trajectory", sequence.trajectory, "Poses of the camera, in TUM format")
      ->type_name("FILE");
  command.add_option("--every", sequence.every_frames, "Every N-th frame (not with --poses slam)")
      ->type_name("N")
      ->check(CLI::Range(1, 10'000'000).description(""))
      ->capture_default_str();
  command.add_option("--method", arguments.method, "What is left out of the map")
      ->check(CLI::IsMember({"none", "full"}).description(""))
      ->type_name("none|full")
      ->capture_default_str();
  command.add_flag("--json", arguments.json, "Write JSON instead of tables");
  command.add_option("--config", arguments.config, "YAML file; without it, the defaults")
      ->type_name("FILE");
  command.add_option("--set", arguments.overrides, "map_server.key=value or slam.key=value")
      ->take_all()
      ->type_name("KEY=VALUE");
  command.footer(kEvalMapFooter);
}

}  // namespace

void add_eval_map_command(CLI::App& eval) {
  CLI::App& command = *eval.add_subcommand(
      "map", "Traces of people, objects and sizes of the map of a sequence, against the truth");
  const auto arguments = std::make_shared<EvalMapArguments>();
  describe(command, *arguments);
  command.callback([arguments] { run(*arguments); });
}

}  // namespace tsg
