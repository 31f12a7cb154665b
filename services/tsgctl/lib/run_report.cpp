#include "services/tsgctl/lib/run_report.hpp"

#include <algorithm>
#include <string>

namespace tsg {
namespace {

using nlohmann::json;

json summary_json(const Summary& summary) {
  return {{"count", summary.count},   {"rmse", summary.rmse},   {"mean", summary.mean},
          {"median", summary.median}, {"std", summary.std_dev}, {"min", summary.min},
          {"max", summary.max}};
}

json accuracy_json(const std::optional<TrajectoryAccuracy>& accuracy) {
  if (!accuracy) return nullptr;
  return {{"ate_m", summary_json(accuracy->ate_m)},
          {"rpe_translation_m", summary_json(accuracy->rpe_translation_m)},
          {"rpe_rotation_deg", summary_json(accuracy->rpe_rotation_deg)},
          {"rpe_delta", accuracy->rpe_delta}};
}

json percentiles_json(const Percentiles& values) {
  return {{"p50", values.p50}, {"p99", values.p99}};
}

json frames_json(const RunReport& report) {
  const TrackingTotals& tracking = report.tracking;
  return {{"total", report.frames_total}, {"answered", tracking.answered},
          {"tracked", tracking.tracked},  {"lost", tracking.lost},
          {"late", report.frames_late},   {"dropped", frames_dropped(report)}};
}

json masks_json(const RunReport& report) {
  const TrackingTotals& tracking = report.tracking;
  const double rate = tracking.answered == 0 ? 0.0
                                             : static_cast<double>(tracking.with_mask) /
                                                   static_cast<double>(tracking.answered);
  return {{"frames_with_mask", tracking.with_mask},
          {"rate", rate},
          {"age_frames", percentiles_json(tracking.mask_age_frames)}};
}

json stages_json(const TrackingTotals& tracking) {
  return {{"extract", percentiles_json(tracking.extract_ms)},
          {"match", percentiles_json(tracking.match_ms)},
          {"optimise", percentiles_json(tracking.optimise_ms)},
          {"total", percentiles_json(tracking.total_ms)}};
}

json processes_json(const std::vector<ProcessUse>& processes) {
  json result = json::object();
  for (const ProcessUse& process : processes) {
    result[process.service] = {{"cpu_s", process.cpu_seconds},
                               {"peak_rss_mib", process.peak_rss_mib},
                               {"end", process.end}};
  }
  return result;
}

}  // namespace

std::uint64_t frames_dropped(const RunReport& report) {
  // Of a complete run, what has no answer; slam's own count knows no hole at the end.
  const bool is_complete = report.problem.empty();
  const std::uint64_t missing =
      is_complete ? report.frames_total - std::min(report.frames_total, report.tracking.answered)
                  : report.tracking.dropped;
  return missing - std::min(missing, report.frames_late);
}

json to_json(const RunReport& report) {
  json objects = json::array();
  for (const ObjectCount& object : report.objects) {
    objects.push_back({{"class", object.class_name}, {"count", object.count}});
  }
  json files = json::array();
  for (const OutputFile& file : report.files) {
    files.push_back({{"name", file.name}, {"bytes", file.bytes}});
  }
  return {{"version", report.version},
          {"input", report.input},
          {"pace", report.pace},
          {"segmentation", report.segmentation},
          {"model", report.model.empty() ? json(nullptr) : json(report.model)},
          {"completed", report.problem.empty()},
          {"problem", report.problem.empty() ? json(nullptr) : json(report.problem)},
          {"duration_s", report.duration_s},
          {"frames", frames_json(report)},
          {"accuracy", accuracy_json(report.accuracy)},
          {"accuracy_live", accuracy_json(report.accuracy_live)},
          {"stages_ms", stages_json(report.tracking)},
          {"latency_ms", percentiles_json(report.tracking.latency_ms)},
          {"masks", masks_json(report)},
          {"objects", std::move(objects)},
          {"processes", processes_json(report.processes)},
          {"files", std::move(files)},
          {"services", report.services}};
}

std::vector<ObjectCount> objects_of(const json& save_map_reply) {
  std::vector<ObjectCount> objects;
  const auto found = save_map_reply.find("objects");
  if (found == save_map_reply.end() || !found->is_array()) return objects;
  for (const json& object : *found) {
    objects.push_back({object.value("class", std::string("?")), object.value("max_in_view", 0ULL)});
  }
  return objects;
}

}  // namespace tsg
