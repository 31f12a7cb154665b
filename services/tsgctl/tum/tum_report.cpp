#include "services/tsgctl/tum/tum_report.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "common/dataset/evaluation.hpp"
#include "services/tsgctl/lib/text_format.hpp"
#include "services/tsgctl/tum/paper_tables.hpp"

namespace tsg {
namespace {

using nlohmann::json;
using Row = std::vector<std::string>;

/// A line of the paper's tables.
struct Figure {
  const char* name;
  double PaperErrors::*paper;
  double Summary::*ours;
};
constexpr std::array<Figure, 4> kFigures{{{"mean", &PaperErrors::mean, &Summary::mean},
                                          {"median", &PaperErrors::median, &Summary::median},
                                          {"rmse", &PaperErrors::rmse, &Summary::rmse},
                                          {"std", &PaperErrors::std_dev, &Summary::std_dev}}};

constexpr const char* kNone = "-";

std::string title_of(int table) {
  const std::array<const char*, 4> subjects{"static scenes", "people who sit", "people who walk",
                                            "improvement of ATE over ORB-SLAM3"};
  return "Table " + std::to_string(table) + ": " + subjects.at(static_cast<std::size_t>(table - 2));
}

std::string percent(std::optional<double> fraction) {
  return fraction ? fixed(100.0 * *fraction, 2) + " %" : kNone;
}

std::optional<double> rate(std::optional<double> reference, std::optional<double> error) {
  if (!reference || !error || *reference <= 0.0) return std::nullopt;
  return improvement_rate(*reference, *error);
}

std::string metres(std::optional<double> value) { return value ? fixed(*value, 4) : kNone; }

/// No set of numbers has such figures: misprinted.
bool is_impossible(const PaperErrors& errors) { return errors.rmse < errors.mean; }

std::string paper_cell(const PaperErrors& errors, const Figure& figure) {
  const bool is_marked = figure.paper == &PaperErrors::rmse && is_impossible(errors);
  return fixed(errors.*figure.paper, 4) + (is_marked ? "!" : "");
}

/// Which of a run's errors a block of the table is about.
struct Metric {
  const char* name;
  PaperErrors PaperResult::*paper;  ///< null where the paper has none
  Summary TrajectoryAccuracy::*ours;
};
constexpr std::array<Metric, 3> kMetrics{
    {{"ATE [m]", &PaperResult::ate, &TrajectoryAccuracy::ate_m},
     {"RPE [m]", &PaperResult::rpe, &TrajectoryAccuracy::rpe_translation_m},
     {"RPE [deg]", nullptr, &TrajectoryAccuracy::rpe_rotation_deg}}};

std::optional<double> figure_of(const std::optional<TumRun>& run,
                                const Metric& metric,
                                const Figure& figure) {
  if (!run) return std::nullopt;
  return run->accuracy.*metric.ours.*figure.ours;
}

Row figure_row(const TumSequenceResult& result, const Metric& metric, const Figure& figure) {
  Row row{metric.name, figure.name, kNone, kNone, kNone};
  std::optional<double> orb_slam3;
  const PaperSequence* paper = find_paper_sequence(result.name);
  if (paper != nullptr && metric.paper != nullptr) {
    const PaperErrors& orb = paper->orb_slam3.*metric.paper;
    const PaperErrors& tsg = paper->tsg_slam.*metric.paper;
    orb_slam3 = orb.*figure.paper;
    row[2] = paper_cell(orb, figure);
    row[3] = paper_cell(tsg, figure);
    row[4] = percent(rate(orb_slam3, tsg.*figure.paper));
  }
  const auto plain = figure_of(result.plain, metric, figure);
  const auto tsg = figure_of(result.tsg, metric, figure);
  row.insert(row.end(), {metres(plain), metres(tsg), percent(rate(plain, tsg)),
                         percent(rate(orb_slam3, tsg ? tsg : plain))});
  return row;
}

Row frames_row(const TumSequenceResult& result) {
  const auto cell = [](const std::optional<TumRun>& run) {
    return run ? std::to_string(run->frames - run->lost) + "/" + std::to_string(run->frames)
               : std::string(kNone);
  };
  return {"tracked",          "frames",         kNone, kNone, kNone,
          cell(result.plain), cell(result.tsg), kNone, kNone};
}

std::string sequence_text(const TumSequenceResult& result) {
  std::vector<Row> rows{{result.name, "", "ORB-SLAM3*", "TSG-SLAM*", "IR*", "plain", "with removal",
                         "IR", "IR to ORB-SLAM3*"}};
  for (const Metric& metric : kMetrics) {
    for (const Figure& figure : kFigures) rows.push_back(figure_row(result, metric, figure));
  }
  rows.push_back(frames_row(result));
  const std::string delta = result.plain ? result.plain->accuracy.rpe_delta : "";
  return "\n" + format_table(rows) + (delta.empty() ? "" : "RPE over " + delta + "\n") +
         (result.problem.empty() ? "" : "problem: " + result.problem + "\n");
}

const TumSequenceResult* find_result(const TumReport& report, std::string_view name) {
  const auto found =
      std::find_if(report.sequences.begin(), report.sequences.end(),
                   [&](const TumSequenceResult& result) { return result.name == name; });
  return found == report.sequences.end() ? nullptr : &*found;
}

/// The paper's rates and ours: over our own run without removal, and over the paper's ORB-SLAM3.
Row comparison_row(const PaperComparison& comparison,
                   std::optional<double> PaperRates::*rate_of,
                   const Figure& figure,
                   const TumSequenceResult* result) {
  Row row{std::string(comparison.name), figure.name};
  for (const PaperRates& rates : comparison.rates) {
    const auto& value = rates.*rate_of;
    row.push_back(value ? fixed(*value, 2) + " %" : kNone);
  }
  if (result == nullptr) {
    row.insert(row.end(), 2, kNone);
    return row;
  }
  const double orb_slam3 = find_paper_sequence(comparison.name)->orb_slam3.ate.*figure.paper;
  const auto plain = figure_of(result->plain, kMetrics[0], figure);
  const auto tsg = figure_of(result->tsg, kMetrics[0], figure);
  row.push_back(percent(rate(plain, tsg)));
  row.push_back(percent(rate(orb_slam3, tsg ? tsg : plain)));
  return row;
}

std::string comparison_text(const TumReport& report) {
  Row heading{"", "ATE"};
  for (const std::string_view system : kComparedSystems)
    heading.push_back(std::string(system) + "*");
  heading.insert(heading.end(), {"here", "here, to ORB-SLAM3*"});
  std::vector<Row> rows{heading};
  for (const PaperComparison& comparison : paper_comparisons()) {
    const TumSequenceResult* result = find_result(report, comparison.name);
    rows.push_back(comparison_row(comparison, &PaperRates::rmse, kFigures[2], result));
    rows.push_back(comparison_row(comparison, &PaperRates::std_dev, kFigures[3], result));
  }
  return "\n" + format_table(rows);
}

std::string table_text(const TumReport& report, int table) {
  if (table == 5) return comparison_text(report);
  std::string text;
  for (const TumSequenceResult& result : report.sequences) {
    const PaperSequence* paper = find_paper_sequence(result.name);
    if (paper != nullptr && paper->table == table) text += sequence_text(result);
  }
  return text.empty() ? "  none of its sequences was run\n" : text;
}

bool has_misprint(const TumReport& report) {
  return std::any_of(report.sequences.begin(), report.sequences.end(),
                     [](const TumSequenceResult& result) {
                       const PaperSequence* paper = find_paper_sequence(result.name);
                       return paper != nullptr && is_impossible(paper->tsg_slam.ate);
                     });
}

std::string notes(const TumReport& report) {
  std::string text =
      "\n* as the paper prints it. IR: improvement rate (eq. 12) of the run with removal over the "
      "plain one.\n  The paper does not say over which time it takes its RPE.\n";
  if (has_misprint(report)) {
    text += "! no RMSE is below its mean: a misprint; the printed mean and STD make";
    for (const TumSequenceResult& result : report.sequences) {
      const PaperSequence* paper = find_paper_sequence(result.name);
      if (paper == nullptr || !is_impossible(paper->tsg_slam.ate)) continue;
      const PaperErrors& ate = paper->tsg_slam.ate;
      text += " " + fixed(std::hypot(ate.mean, ate.std_dev), 4) + " (" + result.name + ")";
    }
    text += "\n";
  }
  if (report.segmentation == "off") {
    text +=
        "There were no masks, so nothing was removed by class: --segmentation model --model FILE "
        "removes people.\n";
  }
  return text;
}

std::string missing_text(const TumReport& report) {
  if (report.missing.empty()) return "";
  std::string text = "\nmissing:";
  for (const std::string& name : report.missing) text += " " + name;
  return text + "\n  fetch them: " + report.fetch_command + "\n";
}

json to_json(const Summary& summary) {
  return {{"count", summary.count}, {"mean", summary.mean},   {"median", summary.median},
          {"rmse", summary.rmse},   {"std", summary.std_dev}, {"max", summary.max}};
}

json to_json(const PaperResult& result) {
  const auto errors = [](const PaperErrors& values) {
    return json{{"mean", values.mean},
                {"median", values.median},
                {"rmse", values.rmse},
                {"std", values.std_dev}};
  };
  return {{"ate_m", errors(result.ate)}, {"rpe_m", errors(result.rpe)}};
}

json to_json(const std::optional<TumRun>& run) {
  if (!run) return nullptr;
  return {{"frames", run->frames},
          {"frames_lost", run->lost},
          {"ate_m", to_json(run->accuracy.ate_m)},
          {"rpe_m", to_json(run->accuracy.rpe_translation_m)},
          {"rpe_deg", to_json(run->accuracy.rpe_rotation_deg)},
          {"rpe_delta", run->accuracy.rpe_delta}};
}

json improvement_json(const TumSequenceResult& result) {
  if (!result.plain || !result.tsg) return nullptr;
  json rates;
  for (const Figure& figure : kFigures) {
    const auto fraction = rate(figure_of(result.plain, kMetrics[0], figure),
                               figure_of(result.tsg, kMetrics[0], figure));
    rates[figure.name] = fraction ? json(*fraction) : json(nullptr);
  }
  return rates;
}

json to_json(const TumSequenceResult& result) {
  json entry{{"name", result.name},
             {"table", nullptr},
             {"paper", nullptr},
             {"plain", to_json(result.plain)},
             {"tsg", to_json(result.tsg)},
             {"ate_improvement", improvement_json(result)},
             {"problem", result.problem.empty() ? json(nullptr) : json(result.problem)}};
  if (const PaperSequence* paper = find_paper_sequence(result.name)) {
    entry["table"] = paper->table;
    entry["paper"] = {{"orb_slam3", to_json(paper->orb_slam3)},
                      {"tsg_slam", to_json(paper->tsg_slam)}};
  }
  return entry;
}

}  // namespace

std::string to_text(const TumReport& report) {
  std::string text;
  for (const int table : report.tables) {
    text += (text.empty() ? "" : "\n") + title_of(table) + "\n" + table_text(report, table);
  }
  for (const TumSequenceResult& result : report.sequences) {
    if (find_paper_sequence(result.name) == nullptr) text += sequence_text(result);
  }
  return text + notes(report) + missing_text(report);
}

json to_json(const TumReport& report) {
  json sequences = json::array();
  for (const TumSequenceResult& result : report.sequences) sequences.push_back(to_json(result));
  return {{"tables", report.tables},
          {"segmentation", report.segmentation},
          {"model", report.model.empty() ? json(nullptr) : json(report.model)},
          {"sequences", std::move(sequences)},
          {"missing", report.missing},
          {"fetch", report.fetch_command.empty() ? json(nullptr) : json(report.fetch_command)}};
}

}  // namespace tsg
