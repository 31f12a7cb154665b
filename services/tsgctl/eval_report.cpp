#include "services/tsgctl/eval_report.hpp"

#include <array>
#include <utility>
#include <vector>

#include "services/tsgctl/lib/text_format.hpp"

namespace tsg {
namespace {

using nlohmann::json;
using Row = std::vector<std::string>;

/// The figures of the paper's tables, in its order, and the extremes.
struct Figure {
  const char* name;
  double Summary::*value;
};
constexpr std::array<Figure, 6> kFigures{{{"rmse", &Summary::rmse},
                                          {"mean", &Summary::mean},
                                          {"median", &Summary::median},
                                          {"std", &Summary::std_dev},
                                          {"min", &Summary::min},
                                          {"max", &Summary::max}}};

Row heading() {
  Row row{""};
  for (const Figure& figure : kFigures) row.emplace_back(figure.name);
  return row;
}

Row figures_row(const std::string& name, const Summary& summary, int digits) {
  Row row{name};
  for (const Figure& figure : kFigures) row.push_back(fixed(summary.*figure.value, digits));
  return row;
}

/// Nothing to improve on where the reference has no error.
std::optional<double> rate(const Figure& figure, const Summary& reference, const Summary& own) {
  if (reference.*figure.value <= 0.0) return std::nullopt;
  return improvement_rate(reference.*figure.value, own.*figure.value);
}

Row improvement_row(const Summary& reference, const Summary& own) {
  Row row{"improvement"};
  for (const Figure& figure : kFigures) {
    const auto fraction = rate(figure, reference, own);
    row.push_back(fraction ? fixed(100.0 * *fraction, 2) + " %" : "-");
  }
  return row;
}

void add_rows(std::vector<Row>& rows,
              const std::string& name,
              const Summary& own,
              const Summary* reference,
              int digits) {
  rows.push_back(figures_row(name, own, digits));
  if (reference == nullptr) return;
  rows.push_back(figures_row("  reference", *reference, digits));
  rows.push_back(improvement_row(*reference, own));
  rows.back().front() = "  improvement";
}

json figures_json(const Summary& summary) {
  json figures;
  for (const Figure& figure : kFigures) figures[figure.name] = summary.*figure.value;
  return figures;
}

json improvement_json(const Summary& reference, const Summary& own) {
  json rates;
  for (const Figure& figure : kFigures) {
    const auto fraction = rate(figure, reference, own);
    rates[figure.name] = fraction ? json(*fraction) : json(nullptr);
  }
  return rates;
}

json input_json(const char* metric, const EvalInput& input) {
  json root{{"metric", metric},
            {"ground_truth", input.truth},
            {"estimate", input.estimate},
            {"max_difference_s", input.max_difference_s}};
  if (!input.reference.empty()) root["reference_estimate"] = input.reference;
  return root;
}

std::string names(const EvalInput& input) {
  std::string text = input.estimate + " against " + input.truth + "\n";
  if (!input.reference.empty()) text += "reference: " + input.reference + "\n";
  return text;
}

std::string text_of_ms(const EvalInput& input) {
  return fixed(input.max_difference_s * 1000.0, 0) + " ms";
}

std::string delta_text(const RpeReport& report) {
  if (report.unit == DeltaUnit::kSeconds) return fixed(report.delta, 2) + " s";
  return fixed(report.delta, 0) + (report.delta == 1.0 ? " frame" : " frames");
}

}  // namespace

std::string to_text(const AteReport& report) {
  std::vector<Row> rows{heading()};
  add_rows(rows, "ATE [m]", report.error_m,
           report.reference_error_m ? &*report.reference_error_m : nullptr, 6);
  return names(report.input) + std::to_string(report.error_m.count) + " of " +
         std::to_string(report.poses) + " poses matched within " + text_of_ms(report.input) +
         ", aligned rigidly (no scale)\n\n" + format_table(rows);
}

std::string to_text(const RpeReport& report) {
  const RelativeError* reference = report.reference_error ? &*report.reference_error : nullptr;
  std::vector<Row> rows{heading()};
  add_rows(rows, "RPE [m]", report.error.translation_m,
           reference != nullptr ? &reference->translation_m : nullptr, 6);
  add_rows(rows, "RPE [deg]", report.error.rotation_deg,
           reference != nullptr ? &reference->rotation_deg : nullptr, 4);
  return names(report.input) + std::to_string(report.error.translation_m.count) +
         " pairs of poses " + delta_text(report) + " apart, matched within " +
         text_of_ms(report.input) + "\n\n" + format_table(rows);
}

json to_json(const AteReport& report) {
  json root = input_json("ate", report.input);
  root["poses"] = report.poses;
  root["pairs"] = report.error_m.count;
  root["translation_m"] = figures_json(report.error_m);
  if (report.reference_error_m) {
    root["reference_translation_m"] = figures_json(*report.reference_error_m);
    root["improvement"] = improvement_json(*report.reference_error_m, report.error_m);
  }
  return root;
}

json to_json(const RpeReport& report) {
  json root = input_json("rpe", report.input);
  root["delta"] = report.delta;
  root["delta_unit"] = report.unit == DeltaUnit::kSeconds ? "seconds" : "frames";
  root["pairs"] = report.error.translation_m.count;
  root["translation_m"] = figures_json(report.error.translation_m);
  root["rotation_deg"] = figures_json(report.error.rotation_deg);
  if (report.reference_error) {
    const RelativeError& reference = *report.reference_error;
    root["reference_translation_m"] = figures_json(reference.translation_m);
    root["reference_rotation_deg"] = figures_json(reference.rotation_deg);
    root["improvement"] = improvement_json(reference.translation_m, report.error.translation_m);
  }
  return root;
}

}  // namespace tsg
