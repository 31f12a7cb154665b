#include "services/tsgctl/map_eval/map_report.hpp"

#include <algorithm>
#include <string_view>
#include <vector>

#include "services/tsgctl/lib/text_format.hpp"

namespace tsg {
namespace {

using nlohmann::json;
using Rows = std::vector<std::vector<std::string>>;

std::string percent(double share) { return fixed(100.0 * share, 2) + " %"; }

std::string verdict(bool met, std::string_view target) {
  return (met ? "met: " : "MISSED: ") + std::string(target);
}

std::string size_table(const MapEvalReport& report) {
  const PointCounts& points = report.points;
  const Summary& time_ms = report.integration_ms;
  return format_table(
      {{"keyframes", std::to_string(report.keyframes)},
       {"points measured", std::to_string(points.measured)},
       {"points kept", std::to_string(points.kept), "without people, what moves, bad depth"},
       {"after the voxel filter", std::to_string(points.in_voxels), "of each keyframe"},
       {"points stitched", std::to_string(points.stitched),
        "in the joint cloud, not seen free since"},
       {"after the outlier filter", std::to_string(points.left), "saved"},
       {"leaves", std::to_string(report.leaves), "occupied"},
       {"cloud.ply", format_bytes(report.bytes.cloud)},
       {"map.ot", format_bytes(report.bytes.ot)},
       {"map.bt", format_bytes(report.bytes.bt)},
       {"cloud / octree", fixed(report.bytes.cloud_to_octree(), 1),
        verdict(report.bytes.cloud_to_octree() >= kCloudToOctreeTarget, "at least 47 (map.bt)")},
       {"CPU time of a keyframe", fixed(time_ms.median, 1) + " ms",
        "p99 " + fixed(time_ms.p99, 1) + " ms"}});
}

std::string trace_table(const TraceScore& score) {
  return format_table(
      {{"traces of people", std::to_string(score.traces) + " leaves", percent(score.trace_share()),
        verdict(score.trace_share() <= kTraceShareTarget, "at most 0.50 %")},
       {"off any true surface", std::to_string(score.off_surface) + " leaves",
        percent(score.off_surface_share())}});
}

std::string object_tables(const ObjectScore& score) {
  Rows classes{{"CLASS", "OBJECTS", "TAGS", "MISSING", "SURPLUS"}};
  for (const ClassScore& of_class : score.classes) {
    classes.push_back({of_class.class_name, std::to_string(of_class.objects),
                       std::to_string(of_class.tags), std::to_string(of_class.missing),
                       std::to_string(of_class.surplus)});
  }
  Rows matches{{"OBJECT", "CLASS", "TAG", "CENTRE OFF", "SIZE OFF"}};
  for (const TagMatch& match : score.matches) {
    matches.push_back({match.name, match.class_name, std::to_string(match.tag_id),
                       fixed(100.0 * match.centre_error_m, 1) + " cm", percent(match.size_error)});
  }
  return format_table(classes) + "count error " + std::to_string(score.count_error()) + "\n\n" +
         format_table(matches);
}

json objects_json(const ObjectScore& score) {
  json classes = json::object();
  for (const ClassScore& of_class : score.classes) {
    classes[of_class.class_name] = {{"objects", of_class.objects},
                                    {"tags", of_class.tags},
                                    {"missing", of_class.missing},
                                    {"surplus", of_class.surplus}};
  }
  json matches = json::array();
  for (const TagMatch& match : score.matches) {
    matches.push_back({{"id", match.object_id},
                       {"name", match.name},
                       {"class", match.class_name},
                       {"tag", match.tag_id},
                       {"well_seen", match.is_well_seen},
                       {"centre_error_m", match.centre_error_m},
                       {"size_error", match.size_error}});
  }
  return {{"count_error", score.count_error()},
          {"classes", std::move(classes)},
          {"matches", std::move(matches)}};
}

json traces_json(const TraceScore& score) {
  return {{"leaves", score.traces},           {"share", score.trace_share()},
          {"off_surface", score.off_surface}, {"off_surface_share", score.off_surface_share()},
          {"target", kTraceShareTarget},      {"met", score.trace_share() <= kTraceShareTarget}};
}

}  // namespace

std::string to_text(const MapEvalReport& report) {
  std::string text = report.sequence + ", poses of " + report.poses +
                     (report.exclude ? ", method full\n\n" : ", method none: people and all\n\n") +
                     size_table(report) + "\n";
  if (!report.traces) {
    return text +
           "Nothing tells what is true of this sequence's space (truth_objects.json): no figures "
           "on traces of people and on objects; 'tsgctl simulate' writes it.\n";
  }
  text += trace_table(*report.traces);
  if (report.objects) text += "\n" + object_tables(*report.objects);
  return text;
}

json to_json(const MapEvalReport& report) {
  const PointCounts& points = report.points;
  return {
      {"sequence", report.sequence},
      {"poses", report.poses},
      {"method", report.exclude ? "full" : "none"},
      {"keyframes", report.keyframes},
      {"points",
       {{"measured", points.measured},
        {"kept", points.kept},
        {"in_voxels", points.in_voxels},
        {"stitched", points.stitched},
        {"left", points.left}}},
      {"leaves", report.leaves},
      {"bytes", {{"cloud", report.bytes.cloud}, {"ot", report.bytes.ot}, {"bt", report.bytes.bt}}},
      {"cloud_to_octree",
       {{"ratio", report.bytes.cloud_to_octree()},
        {"target", kCloudToOctreeTarget},
        {"met", report.bytes.cloud_to_octree() >= kCloudToOctreeTarget}}},
      {"integration_ms",
       {{"p50", report.integration_ms.median}, {"p99", report.integration_ms.p99}}},
      {"traces", report.traces ? traces_json(*report.traces) : json(nullptr)},
      {"objects", report.objects ? objects_json(*report.objects) : json(nullptr)}};
}

}  // namespace tsg
