#include "services/tsgctl/dynamic/methods_run.hpp"

#include <algorithm>
#include <utility>

#include "services/tsgctl/dynamic/dynamic_run.hpp"

namespace tsg {
namespace {

namespace fs = std::filesystem;

/// Absolute and without a slash at its end, so that it has a name.
fs::path named(const fs::path& folder) {
  const fs::path path = fs::absolute(folder).lexically_normal();
  return path.has_filename() ? path : path.parent_path();
}

class MethodsRunner {
 public:
  MethodsRunner(const MethodsOptions& options,
                const std::function<void(const MethodsProgress&)>& on_progress)
      : options_(options), on_progress_(on_progress) {}

  [[nodiscard]] SequenceRuns run_all(const std::string& name, const fs::path& folder) const;

 private:
  [[nodiscard]] MethodRun run(const SequenceRuns& sequence,
                              const std::string& name,
                              DynamicMethod method,
                              const MaskOptions& masks) const;
  void run(const SequenceRuns& sequence, const DynamicOptions& options, MethodRun& result) const;

  const MethodsOptions& options_;
  const std::function<void(const MethodsProgress&)>& on_progress_;
};

SequenceRuns MethodsRunner::run_all(const std::string& name, const fs::path& folder) const {
  SequenceRuns sequence{.name = name, .folder = folder.string(), .methods = {}, .variants = {}};
  for (const DynamicMethod method : options_.methods) {
    sequence.methods.push_back(run(sequence, std::string(name_of(method)), method, {}));
  }
  for (const RunVariant* variant : options_.variants) {
    sequence.variants.push_back(
        run(sequence, std::string(variant->name), DynamicMethod::kFull, variant->masks));
  }
  return sequence;
}

MethodRun MethodsRunner::run(const SequenceRuns& sequence,
                             const std::string& name,
                             DynamicMethod method,
                             const MaskOptions& masks) const {
  DynamicOptions options;
  options.bench.folder = sequence.folder;
  options.bench.frames = options_.frames;
  options.bench.run.slam = options_.slam;
  options.bench.run.slam.dynamic_filter.method = method;
  options.bench.run.masks = masks;
  MethodRun result{.name = name, .problem = {}};
  try {
    run(sequence, options, result);
  } catch (const FatalError& error) {
    result = {.name = name, .problem = error.what()};
  }
  return result;
}

void MethodsRunner::run(const SequenceRuns& sequence,
                        const DynamicOptions& options,
                        MethodRun& result) const {
  const std::string title = sequence.name + ", " + result.name;
  on_progress_({title});
  std::optional<InstanceTruth> truth;
  if (fs::exists(options.bench.folder / "instances.json")) {
    truth = value_or_throw(InstanceTruth::open(options.bench.folder));
  }
  const DynamicRun run =
      run_dynamic(options, truth ? &*truth : nullptr, [&](std::uint64_t done, std::uint64_t total) {
        on_progress_({title, done, total});
      });
  std::vector<double> tracking_ms;
  tracking_ms.reserve(run.bench.frames.size());
  for (const BenchFrame& frame : run.bench.frames) tracking_ms.push_back(frame.tracking_ms);
  result.frames = run.bench.frames.size();
  result.frames_lost = run.frames_lost();
  result.tracking_p50_ms = spread_of(std::move(tracking_ms)).p50;
  result.accuracy = run.accuracy;
  if (truth) result.verdicts = summarise(run.scores);
}

}  // namespace

std::vector<std::string> sequence_names(const std::vector<fs::path>& folders) {
  std::vector<std::string> names;
  names.reserve(folders.size());
  for (const fs::path& folder : folders) names.push_back(named(folder).filename().string());
  const std::vector<std::string> own = names;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (std::count(own.begin(), own.end(), own[i]) == 1) continue;
    names[i] = (named(folders[i]).parent_path().filename() / own[i]).string();
  }
  return names;
}

MethodsReport run_methods(const MethodsOptions& options,
                          const std::string& command,
                          const MethodsHooks& hooks) {
  MethodsReport report;
  report.command = command;
  for (const DynamicMethod method : options.methods) report.methods.emplace_back(name_of(method));
  for (const RunVariant* variant : options.variants) {
    report.variants.emplace_back(variant->name);
    report.variant_texts.emplace_back(variant->text);
  }
  const MethodsRunner runner(options, hooks.on_progress);
  const std::vector<std::string> names = sequence_names(options.sequences);
  for (std::size_t i = 0; i < names.size(); ++i) {
    report.sequences.push_back(runner.run_all(names[i], options.sequences[i]));
    hooks.on_sequence(report);
  }
  return report;
}

}  // namespace tsg
