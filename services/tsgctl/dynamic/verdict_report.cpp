#include "services/tsgctl/dynamic/verdict_report.hpp"

#include <sstream>
#include <utility>

#include "common/core/time.hpp"
#include "services/tsgctl/lib/text_format.hpp"

namespace tsg {
namespace {

using nlohmann::json;
using Row = std::vector<std::string>;

constexpr std::array<const char*, kFeatureKinds> kKindKeys{
    "static_things", "dynamic_classes", "potentially_dynamic_moving", "potentially_dynamic_still",
    "other_moving"};
constexpr std::array<const char*, 4> kStateKeys{"still", "moving", "at_rest", "unknown"};

std::string number(std::optional<double> share) { return share ? fixed(*share, 4) : "-"; }

std::string percent(std::optional<double> share) {
  return share ? fixed(100.0 * *share, 1) + " %" : "-";
}

std::string met(std::optional<double> value, double target) {
  if (!value) return "-";
  return *value >= target ? "met" : "missed";
}

/// "612/20" for 612 removed and 20 kept.
std::string removed_and_kept(const Judged& judged) {
  return std::to_string(judged.removed) + "/" + std::to_string(judged.kept);
}

Row counts_row(const std::string& name, const VerdictCounts& counts) {
  return {name,
          number(counts.recall()),
          number(counts.precision()),
          removed_and_kept(counts.of(TrueState::kMoving)),
          removed_and_kept(counts.of(TrueState::kStill)),
          removed_and_kept(counts.of(TrueState::kResting))};
}

std::string totals_table(const VerdictReport& report, const VerdictSummary& summary) {
  const auto recall = summary.total.recall();
  const auto precision = summary.total.precision();
  const std::string margin = std::to_string(report.margin_px) + " px";
  std::vector<Row> rows{
      {"features removed/kept", "recall", "precision", "moving", "still", "at rest"},
      counts_row("away from edges (" + margin + ")", summary.total),
      {"  target", fixed(kRecallTarget, 2) + " " + met(recall, kRecallTarget),
       fixed(kPrecisionTarget, 2) + " " + met(precision, kPrecisionTarget)},
      counts_row("with those at edges", summary.with_edges())};
  const auto spread = [](const char* name, const FrameSpread& figure) {
    if (figure.frames == 0) return std::string(name) + " by frame: no frame has enough features\n";
    return std::string(name) + " by frame: median " + fixed(figure.median, 3) + ", worst " +
           fixed(figure.worst, 3) + ", over " + std::to_string(figure.frames) + " frames\n";
  };
  const std::uint64_t unknown = summary.with_edges().of(TrueState::kUnknown).total();
  return format_table(rows) + spread("recall", summary.recall) +
         spread("precision", summary.precision) +
         (unknown == 0 ? ""
                       : std::to_string(unknown) +
                             " features lie on things whose motion the sequence does not tell\n");
}

std::string classes_table(const VerdictSummary& summary) {
  std::vector<Row> rows{{"class", "recall", "moving", "still", "at rest"}};
  for (const auto& [name, counts] : summary.by_class) {
    rows.push_back({name, number(counts.recall()), removed_and_kept(counts.of(TrueState::kMoving)),
                    removed_and_kept(counts.of(TrueState::kStill)),
                    removed_and_kept(counts.of(TrueState::kResting))});
  }
  return "features removed/kept by class of the true thing, away from edges\n" +
         format_table(rows, 2);
}

std::string share_cell(std::optional<double> share, std::optional<double> target) {
  if (!share || !target) return percent(share);
  return percent(share) + ", target " + fixed(100.0 * *target, 0) + " % " + met(share, *target);
}

/// Only things that stay all the time must be kept: what has just been put down may be doubted.
std::optional<double> kept_target(const InstanceTally& instance) {
  return instance.frames_moving == 0 ? std::optional(kKeptTarget) : std::nullopt;
}

std::string instances_table(const VerdictSummary& summary) {
  if (summary.instances.empty()) return "no instance of a potentially dynamic class was visible\n";
  std::vector<Row> rows{{"instance", "id", "moves in", "removed in", "stays in", "kept in"}};
  for (const InstanceTally& instance : summary.instances) {
    const std::string name = instance.name.empty() ? "" : " " + instance.name;
    rows.push_back({instance.class_name + name, std::to_string(instance.id),
                    std::to_string(instance.frames_moving),
                    share_cell(instance.removed_share(), kRemovedTarget),
                    std::to_string(instance.frames_still),
                    share_cell(instance.kept_share(), kept_target(instance))});
  }
  return "instances that may move: frames in which they are visible, and share of those in which "
         "at least 80 % of their features were removed, or kept\n" +
         format_table(rows, 2);
}

std::string kinds_table(const VerdictSummary& summary) {
  std::vector<Row> rows{{"features per frame (the paper's Table 1)", "detected", "left"}};
  for (std::size_t i = 0; i < kFeatureKinds; ++i) {
    rows.push_back({kKindTitles[i], fixed(per_frame(summary.kinds[i].total(), summary.frames), 1),
                    fixed(per_frame(summary.kinds[i].kept, summary.frames), 1)});
  }
  return format_table(rows);
}

std::string accuracy_lines(const VerdictReport& report) {
  std::string text = "frames " + std::to_string(report.scores.size()) + ", " +
                     std::to_string(report.frames_lost) + " without a pose\n";
  if (!report.accuracy) return text;
  return text + "ATE rmse " + fixed(report.accuracy->ate_m.rmse, 4) + " m, RPE rmse " +
         fixed(report.accuracy->rpe_translation_m.rmse, 4) + " m over " +
         report.accuracy->rpe_delta + "\n";
}

json share_json(std::optional<double> share) { return share ? json(*share) : json(nullptr); }

json counts_json(const VerdictCounts& counts) {
  json root{{"recall", share_json(counts.recall())}, {"precision", share_json(counts.precision())}};
  for (std::size_t i = 0; i < kStateKeys.size(); ++i) {
    root[kStateKeys[i]] = {{"removed", counts.by_state[i].removed},
                           {"kept", counts.by_state[i].kept}};
  }
  return root;
}

json spread_json(const FrameSpread& spread) {
  if (spread.frames == 0) return nullptr;
  return {{"frames", spread.frames}, {"median", spread.median}, {"worst", spread.worst}};
}

json instance_json(const InstanceTally& instance) {
  return {{"id", instance.id},
          {"class", instance.class_name},
          {"name", instance.name},
          {"frames_moving", instance.frames_moving},
          {"frames_removed", instance.frames_removed},
          {"removed_share", share_json(instance.removed_share())},
          {"frames_still", instance.frames_still},
          {"frames_kept", instance.frames_kept},
          {"kept_share", share_json(instance.kept_share())}};
}

json target_json(std::optional<double> value, double target) {
  return {{"target", target}, {"met", value ? json(*value >= target) : json(nullptr)}};
}

std::string csv_line(const FrameScore& score) {
  std::ostringstream line;
  const auto share = [](std::optional<double> value) { return value ? fixed(*value, 4) : ""; };
  const VerdictCounts counts = score.away_from_edges();
  line << score.seq << ',' << fixed(to_seconds(score.stamp_ns), 6) << ',' << score.is_tracked << ','
       << share(counts.recall()) << ',' << share(counts.precision());
  for (const VerdictCounts* place : {&counts, &score.at_edge}) {
    for (const Judged& judged : place->by_state)
      line << ',' << judged.removed << ',' << judged.kept;
  }
  for (const Judged& kind : score.kinds) line << ',' << kind.kept;
  line << '\n';
  return line.str();
}

}  // namespace

double per_frame(std::uint64_t count, std::size_t frames) {
  return frames == 0 ? 0.0 : static_cast<double>(count) / static_cast<double>(frames);
}

std::string to_text(const VerdictReport& report) {
  const VerdictSummary summary = summarise(report.scores);
  return report.sequence + ", method " + report.method + ", " + report.masks + "\n\n" +
         totals_table(report, summary) + "\n" + classes_table(summary) + "\n" +
         instances_table(summary) + "\n" + kinds_table(summary) + "\n" + accuracy_lines(report);
}

json to_json(const VerdictSummary& summary) {
  json classes = json::object();
  for (const auto& [name, counts] : summary.by_class) classes[name] = counts_json(counts);
  json instances = json::array();
  for (const InstanceTally& instance : summary.instances) {
    instances.push_back(instance_json(instance));
  }
  json kinds = json::object();
  for (std::size_t i = 0; i < kFeatureKinds; ++i) {
    kinds[kKindKeys[i]] = {{"detected", per_frame(summary.kinds[i].total(), summary.frames)},
                           {"left", per_frame(summary.kinds[i].kept, summary.frames)}};
  }
  return {{"frames", summary.frames},
          {"total", counts_json(summary.total)},
          {"with_edges", counts_json(summary.with_edges())},
          {"at_edge", counts_json(summary.at_edge)},
          {"recall_by_frame", spread_json(summary.recall)},
          {"precision_by_frame", spread_json(summary.precision)},
          {"classes", std::move(classes)},
          {"instances", std::move(instances)},
          {"features_per_frame", std::move(kinds)},
          {"targets",
           {{"recall", target_json(summary.total.recall(), kRecallTarget)},
            {"precision", target_json(summary.total.precision(), kPrecisionTarget)}}}};
}

json to_json(const VerdictReport& report) {
  json root = to_json(summarise(report.scores));
  root["sequence"] = report.sequence;
  root["method"] = report.method;
  root["masks"] = report.masks;
  root["margin_px"] = report.margin_px;
  root["frames_lost"] = report.frames_lost;
  root["ate_rmse_m"] = report.accuracy ? json(report.accuracy->ate_m.rmse) : json(nullptr);
  root["rpe_rmse_m"] =
      report.accuracy ? json(report.accuracy->rpe_translation_m.rmse) : json(nullptr);
  return root;
}

std::string to_csv(const std::vector<FrameScore>& scores) {
  std::ostringstream text;
  text << "seq,stamp_s,tracked,recall,precision";
  for (const char* place : {"", "edge_"}) {
    for (const char* state : kStateKeys) {
      text << ',' << place << state << "_removed," << place << state << "_kept";
    }
  }
  for (const char* kind : kKindKeys) text << ',' << kind << "_left";
  text << '\n';
  for (const FrameScore& score : scores) text << csv_line(score);
  return text.str();
}

}  // namespace tsg
