#include "services/tsgctl/dynamic/methods_report.hpp"

#include <algorithm>
#include <functional>
#include <utility>

#include "common/dataset/evaluation.hpp"
#include "services/tsgctl/dynamic/verdict_report.hpp"
#include "services/tsgctl/lib/text_format.hpp"

namespace tsg {
namespace {

using nlohmann::json;
using Row = std::vector<std::string>;
using Cell = std::function<std::string(const SequenceRuns&, const MethodRun&)>;

constexpr const char* kNone = "-";

std::string table_line(const Row& row) {
  std::string line = "|";
  for (const std::string& cell : row) line += " " + cell + " |";
  return line + "\n";
}

/// The first row is the heading.
std::string markdown_table(const std::vector<Row>& rows) {
  std::string text = table_line(rows.front());
  text += table_line(Row(rows.front().size(), "---"));
  for (std::size_t i = 1; i < rows.size(); ++i) text += table_line(rows[i]);
  return text;
}

const MethodRun* find_run(const std::vector<MethodRun>& runs, const std::string& name) {
  const auto found =
      std::find_if(runs.begin(), runs.end(), [&](const auto& run) { return run.name == name; });
  return found == runs.end() ? nullptr : &*found;
}

/// A row for each sequence, a column for each of `names`.
std::string scene_table(const MethodsReport& report,
                        const std::vector<std::string>& names,
                        std::vector<MethodRun> SequenceRuns::*runs,
                        const Cell& cell) {
  Row heading{"sequence"};
  heading.insert(heading.end(), names.begin(), names.end());
  std::vector<Row> rows{heading};
  for (const SequenceRuns& sequence : report.sequences) {
    Row row{sequence.name};
    for (const std::string& name : names) {
      const MethodRun* run = find_run(sequence.*runs, name);
      row.push_back(run == nullptr ? kNone : cell(sequence, *run));
    }
    rows.push_back(std::move(row));
  }
  return markdown_table(rows);
}

std::string percent_cell(std::optional<double> share) {
  return share ? fixed(100.0 * *share, 1) + " %" : kNone;
}

/// An error over few poses looks better than it is: what was lost stands beside it.
std::string with_lost(const std::string& figure, const MethodRun& run) {
  return run.frames_lost == 0 ? figure : figure + " (" + std::to_string(run.frames_lost) + " lost)";
}

std::string ate_cell(const SequenceRuns& /*sequence*/, const MethodRun& run) {
  if (!run.problem.empty()) return "failed";
  return run.accuracy ? with_lost(fixed(run.accuracy->ate_m.rmse, 4), run) : kNone;
}

std::string rpe_cell(const SequenceRuns& /*sequence*/, const MethodRun& run) {
  if (!run.problem.empty()) return "failed";
  if (!run.accuracy) return kNone;
  const std::string figure = fixed(run.accuracy->rpe_translation_m.rmse, 4);
  const bool is_usual = run.accuracy->rpe_delta == "1 s";
  return with_lost(is_usual ? figure : figure + " over " + run.accuracy->rpe_delta, run);
}

std::string share_text(std::optional<double> share) { return share ? fixed(*share, 3) : kNone; }

std::string verdict_cell(const SequenceRuns& /*sequence*/, const MethodRun& run) {
  if (!run.verdicts) return kNone;
  return share_text(run.verdicts->total.recall()) + " / " +
         share_text(run.verdicts->total.precision());
}

/// The error and how many times that with masks in time it is.
std::string variant_cell(const SequenceRuns& sequence, const MethodRun& run) {
  std::string figure = ate_cell(sequence, run);
  const MethodRun* in_time = find_run(sequence.methods, "full");
  if (in_time == nullptr || !in_time->accuracy || !run.accuracy) return figure;
  const double reference = in_time->accuracy->ate_m.rmse;
  if (reference <= 0.0) return figure;
  return figure + ", × " + fixed(run.accuracy->ate_m.rmse / reference, 2);
}

Row run_row(const SequenceRuns& sequence, const MethodRun& run) {
  if (!run.problem.empty()) return {sequence.name, run.name, "failed: " + run.problem};
  const auto metres = [&](Summary TrajectoryAccuracy::*error) {
    return run.accuracy ? fixed(((*run.accuracy).*error).rmse, 4) : kNone;
  };
  const auto& verdicts = run.verdicts;
  return {sequence.name,
          run.name,
          metres(&TrajectoryAccuracy::ate_m),
          percent_cell(ate_improvement(sequence, run)),
          metres(&TrajectoryAccuracy::rpe_translation_m),
          percent_cell(rpe_improvement(sequence, run)),
          std::to_string(run.frames_lost) + "/" + std::to_string(run.frames),
          fixed(run.tracking_p50_ms, 1),
          verdicts ? share_text(verdicts->total.recall()) : kNone,
          verdicts ? share_text(verdicts->total.precision()) : kNone};
}

std::string runs_table(const MethodsReport& report) {
  const Row heading{"sequence",    "run",
                    "ATE, m",      "better than none",
                    "RPE, m",      "better than none",
                    "frames lost", "tracking p50, CPU ms",
                    "recall",      "precision"};
  std::vector<Row> rows{heading};
  for (const SequenceRuns& sequence : report.sequences) {
    for (const MethodRun* run : sequence.all()) {
      rows.push_back(run_row(sequence, *run));
      rows.back().resize(heading.size());
    }
  }
  return markdown_table(rows);
}

Row kinds_row(const std::string& sequence, const MethodRun& run) {
  Row row{sequence, run.name};
  for (const Judged& kind : run.verdicts->kinds) {
    row.push_back(fixed(per_frame(kind.kept, run.verdicts->frames), 1));
  }
  return row;
}

/// The paper's Table 1, as a mean over all frames.
std::string kinds_table(const MethodsReport& report) {
  Row heading{"sequence", "method"};
  heading.insert(heading.end(), kKindTitles.begin(), kKindTitles.end());
  std::vector<Row> rows{heading};
  for (const SequenceRuns& sequence : report.sequences) {
    for (const MethodRun& run : sequence.methods) {
      if (run.verdicts) rows.push_back(kinds_row(sequence.name, run));
    }
  }
  if (rows.size() == 1) return "No sequence tells what moves in it.\n";
  return markdown_table(rows);
}

std::string variants_section(const MethodsReport& report) {
  if (report.variants.empty()) return "";
  std::string text =
      "\n## ATE RMSE of `full` with imperfect masks, m\n\nBeside it: how many times the error with "
      "the mask of each frame in time.\n\n";
  for (std::size_t i = 0; i < report.variants.size(); ++i) {
    text += "* `" + report.variants[i] + "`: masks " + report.variant_texts[i] + "\n";
  }
  return text + "\n" + scene_table(report, report.variants, &SequenceRuns::variants, variant_cell);
}

std::optional<double> improvement(const SequenceRuns& sequence,
                                  const MethodRun& run,
                                  Summary TrajectoryAccuracy::*error) {
  const MethodRun* none = find_run(sequence.methods, "none");
  if (none == nullptr || !none->accuracy || !run.accuracy) return std::nullopt;
  const double reference = ((*none->accuracy).*error).rmse;
  if (reference <= 0.0) return std::nullopt;
  return improvement_rate(reference, ((*run.accuracy).*error).rmse);
}

json optional_json(std::optional<double> value) { return value ? json(*value) : json(nullptr); }

json run_json(const SequenceRuns& sequence, const MethodRun& run) {
  if (!run.problem.empty()) return {{"name", run.name}, {"problem", run.problem}};
  json root{{"name", run.name},
            {"problem", nullptr},
            {"frames", run.frames},
            {"frames_lost", run.frames_lost},
            {"tracking_p50_ms", run.tracking_p50_ms},
            {"ate_rmse_m", nullptr},
            {"rpe_rmse_m", nullptr},
            {"rpe_delta", nullptr},
            {"ate_improvement", optional_json(ate_improvement(sequence, run))},
            {"rpe_improvement", optional_json(rpe_improvement(sequence, run))},
            {"verdicts", run.verdicts ? to_json(*run.verdicts) : json(nullptr)}};
  if (run.accuracy) {
    root["ate_rmse_m"] = run.accuracy->ate_m.rmse;
    root["rpe_rmse_m"] = run.accuracy->rpe_translation_m.rmse;
    root["rpe_delta"] = run.accuracy->rpe_delta;
  }
  return root;
}

}  // namespace

std::vector<const MethodRun*> SequenceRuns::all() const {
  std::vector<const MethodRun*> runs;
  runs.reserve(methods.size() + variants.size());
  for (const MethodRun& run : methods) runs.push_back(&run);
  for (const MethodRun& run : variants) runs.push_back(&run);
  return runs;
}

std::vector<std::string> MethodsReport::problems() const {
  std::vector<std::string> found;
  for (const SequenceRuns& sequence : sequences) {
    for (const MethodRun* run : sequence.all()) {
      if (run->problem.empty()) continue;
      found.push_back(sequence.name + ", " + run->name + ": " + run->problem);
    }
  }
  return found;
}

std::optional<double> ate_improvement(const SequenceRuns& sequence, const MethodRun& run) {
  return improvement(sequence, run, &TrajectoryAccuracy::ate_m);
}

std::optional<double> rpe_improvement(const SequenceRuns& sequence, const MethodRun& run) {
  return improvement(sequence, run, &TrajectoryAccuracy::rpe_translation_m);
}

std::string to_markdown(const MethodsReport& report) {
  const auto by_method = [&](const Cell& cell) {
    return scene_table(report, report.methods, &SequenceRuns::methods, cell);
  };
  const auto improvement_cell = [](const SequenceRuns& sequence, const MethodRun& run) {
    return percent_cell(ate_improvement(sequence, run));
  };
  return "# Methods of dynamic feature removal\n\n    " + report.command +
         "\n\n## ATE RMSE, m\n\n" + by_method(ate_cell) +
         "\n## RPE over one second, translation RMSE, m\n\n" + by_method(rpe_cell) +
         "\n## Improvement of ATE over `none` (eq. 12)\n\n" + by_method(improvement_cell) +
         "\n## Recall / precision of verdicts\n\n" + by_method(verdict_cell) +
         "\n## Features left per frame (the paper's Table 1)\n\n" + kinds_table(report) +
         variants_section(report) + "\n## Every run\n\n" + runs_table(report);
}

json to_json(const MethodsReport& report) {
  json sequences = json::array();
  for (const SequenceRuns& sequence : report.sequences) {
    json methods = json::array();
    json variants = json::array();
    for (const MethodRun& run : sequence.methods) methods.push_back(run_json(sequence, run));
    for (const MethodRun& run : sequence.variants) variants.push_back(run_json(sequence, run));
    sequences.push_back({{"name", sequence.name},
                         {"folder", sequence.folder},
                         {"methods", std::move(methods)},
                         {"variants", std::move(variants)}});
  }
  return {{"command", report.command},
          {"methods", report.methods},
          {"variants", report.variants},
          {"sequences", std::move(sequences)}};
}

}  // namespace tsg
