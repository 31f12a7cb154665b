#include "services/tsgctl/lib/run_summary.hpp"

#include <vector>

#include "services/tsgctl/lib/text_format.hpp"

namespace tsg {
namespace {

using Row = std::vector<std::string>;

std::string milliseconds(const Percentiles& values) {
  return "median " + fixed(values.p50, 1) + " ms, p99 " + fixed(values.p99, 1) + " ms";
}

std::string frames_text(const RunReport& report) {
  const TrackingTotals& tracking = report.tracking;
  std::string text = std::to_string(report.frames_total) + " in the input, " +
                     std::to_string(tracking.tracked) + " tracked, " +
                     std::to_string(tracking.lost) + " lost, " +
                     std::to_string(frames_dropped(report)) + " dropped";
  if (report.frames_late > 0) text += ", " + std::to_string(report.frames_late) + " not sent: late";
  return text;
}

std::string ate_text(const TrajectoryAccuracy& accuracy) {
  const Summary& ate = accuracy.ate_m;
  return "rmse " + fixed(ate.rmse, 4) + " m, median " + fixed(ate.median, 4) + " m, max " +
         fixed(ate.max, 4) + " m over " + std::to_string(ate.count) + " poses";
}

std::string rpe_text(const TrajectoryAccuracy& accuracy) {
  return "rmse " + fixed(accuracy.rpe_translation_m.rmse, 4) + " m and " +
         fixed(accuracy.rpe_rotation_deg.rmse, 3) + " deg over " + accuracy.rpe_delta;
}

void add_accuracy(const RunReport& report, std::vector<Row>& rows) {
  if (!report.accuracy) {
    rows.push_back({"accuracy", "unknown: the input has no ground truth to compare with"});
    return;
  }
  rows.push_back({"ATE", ate_text(*report.accuracy)});
  rows.push_back({"RPE", rpe_text(*report.accuracy)});
  if (report.accuracy_live) rows.push_back({"ATE live", ate_text(*report.accuracy_live)});
}

std::string masks_text(const RunReport& report) {
  if (report.segmentation == "off") return "segmentation is off: moving things are not masked";
  const TrackingTotals& tracking = report.tracking;
  return std::to_string(tracking.with_mask) + " of " + std::to_string(tracking.answered) +
         " frames, age median " + fixed(tracking.mask_age_frames.p50, 0) + ", p99 " +
         fixed(tracking.mask_age_frames.p99, 0) + " frames";
}

std::string objects_text(const std::vector<ObjectCount>& objects) {
  std::string text;
  for (const ObjectCount& object : objects) {
    if (!text.empty()) text += ", ";
    text += std::to_string(object.count) + " x " + object.class_name;
  }
  return text.empty() ? "none" : text;
}

void add_processes(const RunReport& report, std::vector<Row>& rows) {
  std::string label = "processes";
  for (const ProcessUse& process : report.processes) {
    const std::string name =
        process.service + std::string(13 - std::min<std::size_t>(process.service.size(), 12), ' ');
    rows.push_back({label, name + fixed(process.cpu_seconds, 1) + " s CPU, " +
                               fixed(process.peak_rss_mib, 0) + " MiB at most"});
    label.clear();
  }
}

void add_files(const RunReport& report, std::vector<Row>& rows) {
  std::string label = "files";
  for (const OutputFile& file : report.files) {
    rows.push_back({label, report.out + "/" + file.name + " (" + format_bytes(file.bytes) + ")"});
    label.clear();
  }
}

std::string title(const RunReport& report) {
  const std::string what = report.problem.empty() ? "Done" : "Incomplete: " + report.problem;
  return what + "\n" + report.input + " at " + report.pace + " pace in " +
         fixed(report.duration_s, 1) + " s, segmentation " + report.segmentation + "\n\n";
}

}  // namespace

std::string summary_text(const RunReport& report) {
  std::vector<Row> rows;
  rows.push_back({"frames", frames_text(report)});
  add_accuracy(report, rows);
  rows.push_back({"tracking", milliseconds(report.tracking.total_ms) + " a frame"});
  rows.push_back(
      {"latency", milliseconds(report.tracking.latency_ms) + ", image sent to pose sent"});
  rows.push_back({"masks", masks_text(report)});
  rows.push_back({"objects", objects_text(report.objects)});
  add_processes(report, rows);
  add_files(report, rows);
  return title(report) + format_table(rows, 2);
}

}  // namespace tsg
