// tsgctl: the command-line tool of TSG-SLAM. Each command lies in a file of its own.
#include <CLI/CLI.hpp>
#include <exception>
#include <iostream>
#include <string>

#include "common/core/error.hpp"
#include "services/tsgctl/bench_command.hpp"
#include "services/tsgctl/doctor_command.hpp"
#include "services/tsgctl/echo_command.hpp"
#include "services/tsgctl/eval_command.hpp"
#include "services/tsgctl/eval_dynamic_command.hpp"
#include "services/tsgctl/eval_map_command.hpp"
#include "services/tsgctl/eval_tum_command.hpp"
#include "services/tsgctl/hz_command.hpp"
#include "services/tsgctl/map_command.hpp"
#include "services/tsgctl/model_command.hpp"
#include "services/tsgctl/report_command.hpp"
#include "services/tsgctl/run_command.hpp"
#include "services/tsgctl/simulate_command.hpp"
#include "services/tsgctl/status_command.hpp"
#include "services/tsgctl/topics_command.hpp"

namespace {

int report(tsg::ExitCode code, const char* message) {
  std::cerr << "tsgctl: error: " << message << std::endl;
  return static_cast<int>(code);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Runs and examines TSG-SLAM. 'tsgctl COMMAND --help' has examples.", "tsgctl");
  app.set_version_flag("--version", TSG_VERSION);
  // Not CLI11's own check, which says of a mistyped command only that one is missing.
  app.require_subcommand(0, 1);
  app.failure_message([](const CLI::App* /*app*/, const CLI::Error& error) {
    return std::string("tsgctl: error: ") + error.what() + "; --help tells more\n";
  });
  tsg::add_run_command(app);
  tsg::add_map_command(app);
  tsg::add_model_command(app);
  CLI::App& eval = tsg::add_eval_command(app);
  tsg::add_eval_dynamic_command(eval);
  tsg::add_eval_map_command(eval);
  tsg::add_eval_tum_command(app);
  tsg::add_bench_command(app);
  tsg::add_report_command(app);
  tsg::add_simulate_command(app);
  tsg::add_status_command(app);
  tsg::add_topics_command(app);
  tsg::add_echo_command(app);
  tsg::add_hz_command(app);
  tsg::add_doctor_command(app);
  try {
    app.parse(argc, argv);
    if (app.get_subcommands().empty()) throw CLI::RequiredError::Subcommand(1);
    return static_cast<int>(tsg::ExitCode::kOk);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : static_cast<int>(tsg::ExitCode::kUsage);
  } catch (const tsg::FatalError& error) {
    return report(error.code(), error.what());
  } catch (const std::exception& error) {
    return report(tsg::ExitCode::kFailure, error.what());
  }
}
