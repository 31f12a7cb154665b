#include "services/tsgctl/tum/tum_evaluation.hpp"

#include <algorithm>
#include <cstdlib>
#include <iostream>
#include <utility>

#include "common/core/atomic_file.hpp"
#include "services/tsgctl/run/run_session.hpp"
#include "services/tsgctl/tum/paper_tables.hpp"

namespace tsg {
namespace {

namespace fs = std::filesystem;

/// An environment variable; empty where it is not set.
std::string variable(const char* name) {
  const char* value = std::getenv(name);  // NOLINT(concurrency-mt-unsafe): before any thread
  return value == nullptr ? "" : value;
}

bool is_in_tables(const std::string& name, const std::vector<int>& tables) {
  const PaperSequence& paper = *find_paper_sequence(name);
  const auto comparisons = paper_comparisons();
  const bool is_compared = std::any_of(comparisons.begin(), comparisons.end(),
                                       [&](const auto& entry) { return entry.name == name; });
  return std::any_of(tables.begin(), tables.end(), [&](int table) {
    return table == paper.table || (table == 5 && is_compared);
  });
}

bool is_fetched(const fs::path& folder) { return fs::exists(folder / "groundtruth.txt"); }

/// One run, as `tsgctl run --pace lockstep` does it.
Expected<TumRun> run_once(const RunOptions& options, const StopOnSignal& signals) {
  const Sequence sequence = open_sequence(options);
  RunSession session(options, sequence, signals);
  const RunOutcome outcome = session.run();
  const auto written =
      write_file_atomically(options.out / "report.json", to_json(outcome.report).dump(2) + "\n");
  if (outcome.failure) return make_error(outcome.failure->code(), outcome.failure->what());
  if (!written) return tl::unexpected(written.error());
  if (!outcome.report.accuracy) {
    return make_error(
        ExitCode::kEmptyInput,
        "too few poses to compare with the ground truth; see " + (options.out / "logs").string());
  }
  const TrackingTotals& tracking = outcome.report.tracking;
  return TumRun{tracking.answered, tracking.lost, *outcome.report.accuracy};
}

class Evaluation {
 public:
  Evaluation(const TumOptions& options, const StopOnSignal& signals)
      : options_(options), signals_(signals) {}

  [[nodiscard]] TumSequenceResult evaluate(const std::string& name) const {
    TumSequenceResult result{.name = name};
    run(name, SegmentationSource::kOff, result.plain, result.problem);
    if (options_.segmentation != SegmentationSource::kOff) {
      run(name, options_.segmentation, result.tsg, result.problem);
    }
    return result;
  }

 private:
  void run(const std::string& name,
           SegmentationSource segmentation,
           std::optional<TumRun>& run,
           std::string& problem) const {
    const bool is_plain = segmentation == SegmentationSource::kOff;
    const std::string folder = tum_folder_name(name);
    RunOptions options{.input = options_.data / folder,
                       .out = options_.out / folder / (is_plain ? "plain" : "tsg"),
                       .pace = Pace::kLockstep,
                       .segmentation = segmentation,
                       .model = is_plain ? fs::path() : options_.model,
                       .config = options_.config,
                       .overrides = options_.overrides};
    std::cerr << name << (is_plain ? ", plain" : ", with removal") << std::endl;
    try {
      run = value_or_throw(run_once(options, signals_));
    } catch (const FatalError& error) {
      if (signals_.token().stop_requested()) throw;
      problem += (problem.empty() ? "" : "; ") + std::string(error.what());
    }
  }

  const TumOptions& options_;
  const StopOnSignal& signals_;
};

std::string fetch_command(const std::vector<std::string>& missing, const fs::path& data) {
  if (missing.empty()) return "";
  std::string command = "deploy/fetch-tum";
  for (const std::string& name : missing) command += " " + name;
  return command + (data == default_tum_folder() ? "" : " --data " + data.string());
}

}  // namespace

fs::path default_tum_folder() {
  if (const std::string data = variable("TSG_TUM_DATA"); !data.empty()) return data;
  const std::string cache = variable("XDG_CACHE_HOME");
  return (cache.empty() ? fs::path(variable("HOME")) / ".cache" : fs::path(cache)) / "tsg-slam" /
         "tum";
}

Expected<std::vector<std::string>> tum_sequences(const TumOptions& options) {
  std::vector<std::string> names;
  const auto add = [&](const std::string& name) {
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  };
  for (const std::string& given : options.names) {
    const auto name = tum_short_name(given);
    if (!name) return tl::unexpected(name.error());
    add(*name);
  }
  if (!options.names.empty()) return names;
  for (const PaperSequence& sequence : paper_sequences()) {
    const std::string name(sequence.name);
    if (is_in_tables(name, options.tables)) add(name);
  }
  return names;
}

TumReport evaluate_tum(const TumOptions& options, const StopOnSignal& signals) {
  TumReport report{.tables = options.tables,
                   .segmentation = std::string(to_string(options.segmentation)),
                   .model = options.model.string(),
                   .sequences = {},
                   .missing = {},
                   .fetch_command = {}};
  const Evaluation evaluation(options, signals);
  for (const std::string& name : value_or_throw(tum_sequences(options))) {
    if (is_fetched(options.data / tum_folder_name(name))) {
      report.sequences.push_back(evaluation.evaluate(name));
    } else {
      report.missing.push_back(name);
    }
  }
  report.fetch_command = fetch_command(report.missing, options.data);
  return report;
}

}  // namespace tsg
