#pragma once

#include <CLI/App.hpp>
#include <string>
#include <vector>

#include "services/slam/config.hpp"
#include "services/slam/offline/mask_source.hpp"

namespace tsg {

/// Options of commands that run the core of slam in their own process.
struct SlamOptions {
  std::string config;
  std::vector<std::string> overrides;
  std::string method;  ///< of --method; empty where it is not given

  /// The core's part of section "slam". Throws FatalError: kUsage for a setting of another section
  /// or of what --method sets too, kConfig or kMissingInput for what cannot be used.
  [[nodiscard]] SlamConfig load() const;
};

/// Which masks of the sequence the core gets.
struct MaskArguments {
  bool none = false;
  std::vector<std::string> faults;  ///< "key=value" of segmentation.faults

  /// Throws FatalError (kConfig, kUsage) for faults that cannot be.
  [[nodiscard]] MaskOptions load() const;
};

/// Adds --config and --set.
void add_slam_options(CLI::App& command, SlamOptions& options);

/// Adds --no-masks and --mask-fault.
void add_mask_options(CLI::App& command, MaskArguments& arguments);

/// Adds --method, short for --set slam.dynamic_filter.method=M.
void add_method_option(CLI::App& command, std::string& method);

/// `overrides` and what --method adds to them. Throws FatalError (kUsage) where both set the
/// method.
[[nodiscard]] std::vector<std::string> with_method(std::vector<std::string> overrides,
                                                   const std::string& method);

}  // namespace tsg
