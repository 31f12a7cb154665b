#include "services/tsgctl/slam_options.hpp"

#include <CLI/CLI.hpp>
#include <utility>

#include "common/app/config_file.hpp"
#include "common/app/mask_faults_file.hpp"
#include "common/core/error.hpp"
#include "services/slam/lib/dynamic/method.hpp"

namespace tsg {
namespace {

constexpr const char* kMethodKey = "slam.dynamic_filter.method=";

}  // namespace

std::vector<std::string> with_method(std::vector<std::string> overrides,
                                     const std::string& method) {
  if (method.empty()) return overrides;
  for (const std::string& setting : overrides) {
    if (!setting.starts_with(kMethodKey)) continue;
    throw FatalError(ExitCode::kUsage,
                     "--method " + method + " and --set " + setting + ": give one of them");
  }
  overrides.push_back(kMethodKey + method);
  return overrides;
}

SlamConfig SlamOptions::load() const {
  for (const std::string& setting : overrides) {
    if (setting.starts_with("slam.")) continue;
    throw FatalError(ExitCode::kUsage, "--set " + setting +
                                           ": only slam runs here; give slam.key=value, as in "
                                           "slam.features.max_features=800");
  }
  const std::vector<std::string> settings = with_method(overrides, method);
  const ConfigFile file =
      config.empty() ? ConfigFile::from_overrides(settings) : ConfigFile::load(config, settings);
  return load_slam_config(file).core;
}

MaskOptions MaskArguments::load() const {
  const std::string section = "mask-fault";
  std::vector<std::string> overrides;
  for (const std::string& setting : faults) overrides.push_back(section + "." + setting);
  const ConfigFile file = ConfigFile::from_overrides(overrides);
  ConfigReader reader(file, section);
  MaskOptions options{.use = !none};
  read_mask_faults(reader, "", options.faults);
  reader.finish(options.faults.problems());
  return options;
}

void add_mask_options(CLI::App& command, MaskArguments& arguments) {
  command.add_flag("--no-masks", arguments.none, "Leave the sequence's true masks aside");
  command
      .add_option("--mask-fault", arguments.faults,
                  "A fault of the masks, as in segmentation.faults: late_frames=6; repeatable")
      ->take_all()
      ->type_name("KEY=VALUE");
}

void add_slam_options(CLI::App& command, SlamOptions& options) {
  command.add_option("--config", options.config, "YAML file; without it, the defaults")
      ->type_name("FILE");
  command.add_option("--set", options.overrides, "slam.key=value, wins over the file; repeatable")
      ->take_all()
      ->type_name("SLAM.KEY=VALUE");
}

void add_method_option(CLI::App& command, std::string& method) {
  command
      .add_option("--method", method,
                  "How features on moving things are found (slam.dynamic_filter.method)")
      ->check(CLI::IsMember(
                  std::vector<std::string>(kDynamicMethodNames.begin(), kDynamicMethodNames.end()))
                  .description(""))
      ->type_name("none|mask|epipolar|tsg|full");
}

}  // namespace tsg
