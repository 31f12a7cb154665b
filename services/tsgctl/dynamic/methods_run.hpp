#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "services/slam/config.hpp"
#include "services/slam/lib/dynamic/method.hpp"
#include "services/tsgctl/dynamic/methods_report.hpp"
#include "services/tsgctl/dynamic/run_variants.hpp"

namespace tsg {

/// What `tsgctl report methods` is asked for.
struct MethodsOptions {
  std::vector<std::filesystem::path> sequences;
  std::vector<DynamicMethod> methods;
  std::vector<const RunVariant*> variants;  ///< of method full
  SlamConfig slam;                          ///< but for the method
  std::size_t frames = 0;                   ///< the first so many of each; 0: all
};

/// How far it is, before a run begins and after each frame.
struct MethodsProgress {
  std::string run;  ///< "moved_chair, tsg"
  std::uint64_t done = 0;
  std::uint64_t total = 0;
};

/// Names of sequences for tables: the folder's own, with the one above it where two are alike.
[[nodiscard]] std::vector<std::string> sequence_names(
    const std::vector<std::filesystem::path>& folders);

/// What the caller does meanwhile.
struct MethodsHooks {
  std::function<void(const MethodsProgress&)> on_progress;
  std::function<void(const MethodsReport&)> on_sequence;  ///< with all that is done by then
};

/// Runs each method and each variant over each sequence. What fails is told in the report, and the
/// next one is run. `command` becomes the report's.
[[nodiscard]] MethodsReport run_methods(const MethodsOptions& options,
                                        const std::string& command,
                                        const MethodsHooks& hooks);

}  // namespace tsg
