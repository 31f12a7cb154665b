#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "common/app/stop_on_signal.hpp"
#include "services/tsgctl/lib/run_plan.hpp"
#include "services/tsgctl/tum/tum_report.hpp"

namespace tsg {

/// What `tsgctl eval-tum` is asked for.
struct TumOptions {
  std::vector<std::string> names;  ///< short or long; empty: those of the tables
  std::vector<int> tables;         ///< 2 to 5
  std::filesystem::path data;      ///< folder of sequences, as deploy/fetch-tum makes it
  std::filesystem::path out;       ///< a folder for each run is made in it
  SegmentationSource segmentation = SegmentationSource::kOff;
  std::filesystem::path model;
  std::filesystem::path config;
  std::vector<std::string> overrides;
};

/// Where deploy/fetch-tum puts sequences: $TSG_TUM_DATA, else the user's cache.
[[nodiscard]] std::filesystem::path default_tum_folder();

/// Short names of the sequences that are asked for, each once; kUsage for one that cannot be.
[[nodiscard]] Expected<std::vector<std::string>> tum_sequences(const TumOptions& options);

/// Runs the whole system over every sequence that is there, with and without removal of dynamic
/// features, in lockstep. What fails is told in the report, and the next sequence is run. Throws
/// FatalError where the user stops it or the options are wrong. Call on the main thread.
[[nodiscard]] TumReport evaluate_tum(const TumOptions& options, const StopOnSignal& signals);

}  // namespace tsg
