#include "services/tsgctl/simulate_command.hpp"

#include <CLI/CLI.hpp>
#include <filesystem>
#include <iostream>
#include <memory>

#include "services/tsgctl/simulate/sequence_writer.hpp"

namespace tsg {
namespace {

constexpr const char* kFooter = R"(
A made-up room with furniture and a person who walks through it: exact poses, true masks, no noise.
Good for trying the system where no recording is at hand; not for judging its accuracy.

Examples:
  tsgctl simulate out/room && tsgctl run --input out/room --out out/run
  tsgctl simulate out/room --frames 300)";

struct SimulateOptions {
  std::filesystem::path folder;
  SimulationOptions simulation;
};

void run(const SimulateOptions& options) {
  write_simulated_sequence(options.folder, options.simulation);
  std::cout << options.folder.string() << ": " << options.simulation.frames << " frames\n";
}

}  // namespace

void add_simulate_command(CLI::App& app) {
  CLI::App& command =
      *app.add_subcommand("simulate", "Write a made-up sequence in TUM RGB-D layout");
  const auto options = std::make_shared<SimulateOptions>();
  command.add_option("DIR", options->folder, "Folder for the sequence")->required();
  command.add_option("--frames", options->simulation.frames, "Length at 30 Hz (90)")
      ->type_name("N")
      ->check(CLI::Range(1, 100'000).description(""));
  command.footer(kFooter);
  command.callback([options] { run(*options); });
}

}  // namespace tsg
