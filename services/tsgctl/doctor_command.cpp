#include "services/tsgctl/doctor_command.hpp"

#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include "common/core/error.hpp"
#include "services/tsgctl/doctor/host_checks.hpp"
#include "services/tsgctl/doctor/program_checks.hpp"
#include "services/tsgctl/lib/checks.hpp"

namespace tsg {
namespace {

constexpr const char* kDoctorFooter = R"(
Changes nothing. Ends with 0 when nothing is FAIL; what is warn limits what works.

Examples:
  tsgctl doctor
  tsgctl doctor --json | jq '.checks[] | select(.level != "ok")')";

void run(bool json) {
  std::vector<CheckResult> results = check_programs();
  for (const CheckResult& result : check_host()) results.push_back(result);
  if (json) {
    std::cout << checks_json(results).dump(2) << std::endl;
  } else {
    std::cout << checks_text(results);
  }
  const int failures = failures_in(results);
  if (failures == 0) return;
  throw FatalError(ExitCode::kUnavailable, std::to_string(failures) +
                                               (failures == 1 ? " check" : " checks") +
                                               " failed; the fix stands below each FAIL line");
}

}  // namespace

void add_doctor_command(CLI::App& app) {
  CLI::App& command =
      *app.add_subcommand("doctor", "Check this host: shared memory, RouDi, network, programs");
  const auto json = std::make_shared<bool>(false);
  command.add_flag("--json", *json, "For scripts");
  command.footer(kDoctorFooter);
  command.callback([json] { run(*json); });
}

}  // namespace tsg
