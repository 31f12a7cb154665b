#include "services/tsgctl/simulate_command.hpp"

#include <CLI/CLI.hpp>
#include <filesystem>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include "common/app/shipped_files.hpp"
#include "common/core/time.hpp"
#include "common/scene_file/scene_file.hpp"
#include "common/scene_file/scene_library.hpp"
#include "services/tsgctl/lib/text_format.hpp"
#include "services/tsgctl/run/progress.hpp"
#include "services/tsgctl/simulate/scene_options.hpp"
#include "services/tsgctl/simulate/sequence_writer.hpp"
#include "services/tsgctl/simulate/simulate_sequence.hpp"

namespace tsg {
namespace {

constexpr const char* kSimulateFooter = R"(
SCENE is the name of a shipped scene (--list) or the path of a file of your own
(docs/simulation.md). DIR gets rgb/, depth/, mask/, groundtruth.txt, camera.yaml, instances.json and
what 'tsgctl eval map' compares a map with (truth_objects.json, truth_people.bt, truth_surfaces.bt);
the same scene and seed give the same bytes.

Parts of the sensor model for --noise: depth_noise depth_quantisation depth_holes depth_range
colour_noise exposure_drift vignetting motion_blur rolling_shutter.

Examples:
  tsgctl simulate --list
  tsgctl simulate office_walking_xyz --out data/walking
  tsgctl simulate crowd --out data/crowd --frames 90 --seed 7
  tsgctl simulate my_room.yaml --out data/mine --size 320x240 --noise none)";

struct SimulateArguments {
  std::string scene;
  std::filesystem::path folder;
  int frames = 0;  ///< 0: as many as the scene has
  SceneOptions options;
  bool list = false;
};

SceneLibrary shipped_scenes() {
  std::vector<std::filesystem::path> folders;
  for (const std::filesystem::path& folder : config_folders()) folders.push_back(folder / "scenes");
  return SceneLibrary(folders);
}

void list_scenes() {
  std::vector<std::vector<std::string>> rows{{"SCENE", "LENGTH", "PEOPLE", "WHAT IT TESTS"}};
  const SceneLibrary library = shipped_scenes();
  for (const std::filesystem::path& file : library.files()) {
    const auto scene = value_or_throw(load_scene(file));
    rows.push_back({file.stem().string(), fixed(scene.duration_s, 0) + " s",
                    std::to_string(scene.people.size()), scene.description});
  }
  std::cout << format_table(rows);
}

void write_sequence(const SimulateArguments& arguments) {
  auto scene = value_or_throw(
      shipped_scenes().find(arguments.scene).and_then([](const std::filesystem::path& file) {
        return load_scene(file);
      }));
  throw_on_error(apply(arguments.options, scene));
  throw_on_error(check_new_folder(arguments.folder));  // before what takes long
  Progress progress;
  progress.say("building " + scene.name);
  auto simulator = value_or_throw(simulation::Simulator::build(scene));
  const int frames = arguments.frames > 0 ? arguments.frames : simulator.frame_count();
  const std::int64_t start_ns = monotonic_ns();
  const auto state_at = [&](int done) {
    return ProgressState{static_cast<std::uint64_t>(done), static_cast<std::uint64_t>(frames),
                         "rendering", to_seconds(monotonic_ns() - start_ns)};
  };
  throw_on_error(simulate_sequence(simulator, frames, arguments.folder,
                                   [&](int done) { progress.update(state_at(done)); }));
  progress.finish(state_at(frames));
  std::cout << arguments.folder.string() << ": " << frames << " frames of " << scene.name << "\n";
}

void run(const SimulateArguments& arguments) {
  if (arguments.list) {
    list_scenes();
    return;
  }
  if (arguments.scene.empty()) throw CLI::RequiredError("SCENE");
  if (arguments.folder.empty()) throw CLI::RequiredError("--out");
  write_sequence(arguments);
}

}  // namespace

void add_simulate_command(CLI::App& app) {
  CLI::App& command =
      *app.add_subcommand("simulate", "Render a scene into a sequence in TUM RGB-D layout");
  const auto arguments = std::make_shared<SimulateArguments>();
  SceneOptions& options = arguments->options;
  command.add_option("SCENE", arguments->scene, "Name of a shipped scene, or a scene file");
  command.add_option("--out", arguments->folder, "New folder for the sequence")->type_name("DIR");
  command.add_option("--frames", arguments->frames, "How many (all of the scene)")
      ->type_name("N")
      ->check(CLI::Range(1, 1'000'000).description(""));
  command.add_option("--seed", options.seed, "Chance of noise, looks and tremor (the scene's)")
      ->type_name("S");
  command.add_option("--noise", options.noise, "Parts of the sensor model (the scene's)")
      ->type_name("all|none|PART,PART..");
  command.add_option("--size", options.size, "Size of images (the scene's)")->type_name("WxH");
  command.add_flag("--list", arguments->list, "Tell which scenes there are");
  command.footer(kSimulateFooter);
  command.callback([arguments] { run(*arguments); });
}

}  // namespace tsg
