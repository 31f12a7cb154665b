#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "common/core/statistics.hpp"
#include "services/tsgctl/lib/tracking_log.hpp"

namespace tsg {

/// How far an estimated trajectory is from the truth.
struct TrajectoryAccuracy {
  Summary ate_m;              ///< eq. 10, after rigid alignment
  Summary rpe_translation_m;  ///< eq. 11, over rpe_delta
  Summary rpe_rotation_deg;
  std::string rpe_delta;  ///< "1 s", or "1 frame" where the sequence is too short for that
};

struct ProcessUse {
  std::string service;
  double cpu_seconds = 0.0;
  double peak_rss_mib = 0.0;
  std::string end;  ///< "exit code 0", "killed by signal 9 (Killed)"
};

struct OutputFile {
  std::string name;  ///< relative to the output folder
  std::uint64_t bytes = 0;
};

struct ObjectCount {
  std::string class_name;
  std::uint64_t count = 0;  ///< most of them in one view: a lower bound of their number
};

/// All that a run leaves to say: OUT/report.json and the summary at its end.
struct RunReport {
  std::string version;
  std::string input;
  std::string out;
  std::string pace;
  std::string segmentation;
  std::string model;        ///< empty unless segmentation is "model"
  std::string problem;      ///< why the run did not complete; empty where it did
  double duration_s = 0.0;  ///< first frame sent to last frame answered
  std::uint64_t frames_total = 0;
  std::uint64_t frames_late = 0;  ///< that the camera did not send since their time had passed
  TrackingTotals tracking;
  /// Of trajectory.txt; needs ground truth.
  std::optional<TrajectoryAccuracy> accuracy = std::nullopt;
  /// Of the poses as they were published.
  std::optional<TrajectoryAccuracy> accuracy_live = std::nullopt;
  std::vector<ObjectCount> objects;
  std::vector<ProcessUse> processes;
  std::vector<OutputFile> files;
  nlohmann::json services = nlohmann::json::object();  ///< the report of each service, by name
};

/// Frames that the camera sent and tracking never saw.
[[nodiscard]] std::uint64_t frames_dropped(const RunReport& report);

/// The content of report.json (docs/tsgctl.md lists its keys).
[[nodiscard]] nlohmann::json to_json(const RunReport& report);

/// The object counts in a reply of map_server to save_map; none where it has none.
[[nodiscard]] std::vector<ObjectCount> objects_of(const nlohmann::json& save_map_reply);

}  // namespace tsg
