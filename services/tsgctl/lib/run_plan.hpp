#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "common/core/error.hpp"

namespace tsg {

enum class Pace {
  kRealtime,  ///< frames come when their stamps say; what is late is dropped
  kLockstep,  ///< the next frame comes when tracking has answered: deterministic
};

enum class SegmentationSource {
  kDataset,  ///< mask/ and instances.json of the sequence
  kModel,    ///< a network
  kOff,      ///< the process is not started
};

[[nodiscard]] std::string_view to_string(Pace pace);
[[nodiscard]] std::string_view to_string(SegmentationSource source);

/// What the user asked `tsgctl run` for.
struct RunOptions {
  std::filesystem::path input;
  std::filesystem::path out;
  Pace pace = Pace::kRealtime;
  SegmentationSource segmentation = SegmentationSource::kOff;
  std::filesystem::path load_map = {};  ///< map file that slam starts in; empty: a new map
  bool localisation_only = false;       ///< in that map, which stays as it is
  std::filesystem::path save_map = {};  ///< where the map goes at the end; empty: nowhere
  std::filesystem::path model;          ///< network file; set exactly with kModel
  std::filesystem::path labels = {};    ///< names of its classes; empty: those in it
  std::filesystem::path config;         ///< empty: the defaults of the services
  std::vector<std::string> overrides;   ///< "section.key=value", of the user
};

/// One process to start.
struct ProcessPlan {
  std::string service;  ///< its name on the bus and in the configuration: "slam"
  std::filesystem::path executable;
  std::vector<std::string> arguments;
};

/// Which processes make up the run, in the order of their start: the camera is the last, so that no
/// frame is sent before somebody listens.
struct RunPlan {
  std::vector<ProcessPlan> processes;

  [[nodiscard]] const ProcessPlan& camera() const { return processes.back(); }
};

/// kUsage where options contradict each other or a setting is one that an option owns.
[[nodiscard]] Expected<void> check_run_options(const RunOptions& options);

/// The plan for `options`, with the executables in `bin_folder`. kUsage where options contradict
/// each other. Whether overrides are well-formed is for the services to say.
[[nodiscard]] Expected<RunPlan> make_run_plan(const RunOptions& options,
                                              const std::filesystem::path& bin_folder);

}  // namespace tsg
