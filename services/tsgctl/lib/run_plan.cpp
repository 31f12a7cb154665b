#include "services/tsgctl/lib/run_plan.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace tsg {
namespace {

/// Keys that an option of `tsgctl run` decides: setting them as well could only contradict it.
constexpr std::array<std::pair<std::string_view, std::string_view>, 12> kKeysOfOptions{{
    {"camera.source", "--input"},
    {"camera.replay.folder", "--input"},
    {"camera.pace", "--pace"},
    {"camera.wait_for_subscribers", "--segmentation"},
    {"slam.lockstep", "--pace"},
    {"slam.expect_masks", "--segmentation"},
    {"slam.map.load", "--load-map"},
    {"slam.map.localisation_only", "--localisation-only"},
    {"segmentation.provider", "--segmentation"},
    {"segmentation.dataset.folder", "--input"},
    {"segmentation.model.file", "--model"},
    {"segmentation.model.labels", "--labels"},
}};

Expected<void> check_override(const std::string& override_text) {
  const std::string key = override_text.substr(0, override_text.find('='));
  for (const auto& [owned_key, option] : kKeysOfOptions) {
    if (key == owned_key) {
      return make_error(ExitCode::kUsage, "--set " + key + ": tsgctl run sets this by " +
                                              std::string(option) + "; use that option");
    }
  }
  return {};
}

/// Arguments of one service: the user's file and settings, then what the options decide.
class Arguments {
 public:
  explicit Arguments(const RunOptions& options) {
    if (!options.config.empty()) {
      values_.insert(values_.end(), {"--config", options.config.string()});
    }
    for (const std::string& override_text : options.overrides) set(override_text);
  }
  Arguments& set(const std::string& setting) {
    values_.insert(values_.end(), {"--set", setting});
    return *this;
  }
  [[nodiscard]] std::vector<std::string> take() { return std::move(values_); }

 private:
  std::vector<std::string> values_;
};

std::vector<std::string> segmentation_arguments(const RunOptions& options) {
  Arguments arguments(options);
  arguments.set("segmentation.provider=" + std::string(to_string(options.segmentation)));
  if (options.segmentation == SegmentationSource::kDataset) {
    arguments.set("segmentation.dataset.folder=" + options.input.string());
  } else {
    arguments.set("segmentation.model.file=" + options.model.string());
    if (!options.labels.empty()) {
      arguments.set("segmentation.model.labels=" + options.labels.string());
    }
  }
  return arguments.take();
}

std::vector<std::string> slam_arguments(const RunOptions& options) {
  const bool lockstep = options.pace == Pace::kLockstep;
  const bool masks = options.segmentation != SegmentationSource::kOff;
  Arguments arguments(options);
  arguments.set(std::string("slam.lockstep=") + (lockstep ? "true" : "false"))
      .set(std::string("slam.expect_masks=") + (masks ? "true" : "false"));
  if (!options.load_map.empty()) arguments.set("slam.map.load=" + options.load_map.string());
  if (options.localisation_only) arguments.set("slam.map.localisation_only=true");
  return arguments.take();
}

std::vector<std::string> camera_arguments(const RunOptions& options) {
  const bool masks = options.segmentation != SegmentationSource::kOff;
  return Arguments(options)
      .set("camera.source=replay")
      .set("camera.replay.folder=" + options.input.string())
      .set("camera.pace=" + std::string(to_string(options.pace)))
      .set(std::string("camera.wait_for_subscribers=") + (masks ? "2" : "1"))
      .take();
}

}  // namespace

std::string_view to_string(Pace pace) { return pace == Pace::kLockstep ? "lockstep" : "realtime"; }

std::string_view to_string(SegmentationSource source) {
  switch (source) {
    case SegmentationSource::kDataset:
      return "dataset";
    case SegmentationSource::kModel:
      return "model";
    case SegmentationSource::kOff:
      break;
  }
  return "off";
}

Expected<void> check_run_options(const RunOptions& options) {
  if (options.segmentation == SegmentationSource::kModel && options.model.empty()) {
    return make_error(ExitCode::kUsage,
                      "--segmentation model needs a network: add --model FILE.onnx");
  }
  if (options.segmentation != SegmentationSource::kModel && !options.model.empty()) {
    return make_error(ExitCode::kUsage, "--model goes with --segmentation model, not with " +
                                            std::string(to_string(options.segmentation)));
  }
  if (options.model.empty() && !options.labels.empty()) {
    return make_error(ExitCode::kUsage,
                      "--labels names the classes of a network: add --model FILE.onnx");
  }
  if (options.localisation_only && options.load_map.empty()) {
    return make_error(ExitCode::kUsage, "--localisation-only needs a map: add --load-map FILE");
  }
  for (const std::string& override_text : options.overrides) {
    if (auto checked = check_override(override_text); !checked) return checked;
  }
  return {};
}

Expected<RunPlan> make_run_plan(const RunOptions& options,
                                const std::filesystem::path& bin_folder) {
  if (auto checked = check_run_options(options); !checked) {
    return tl::unexpected<Error>(checked.error());
  }
  RunPlan plan;
  if (options.segmentation != SegmentationSource::kOff) {
    plan.processes.push_back(
        {"segmentation", bin_folder / "tsg-segmentation", segmentation_arguments(options)});
  }
  plan.processes.push_back({"slam", bin_folder / "tsg-slam", slam_arguments(options)});
  plan.processes.push_back(
      {"map_server", bin_folder / "tsg-map-server", Arguments(options).take()});
  plan.processes.push_back({"camera", bin_folder / "tsg-camera", camera_arguments(options)});
  return plan;
}

}  // namespace tsg
