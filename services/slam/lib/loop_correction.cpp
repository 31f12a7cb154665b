#include "services/slam/lib/loop_correction.hpp"

#include <unordered_map>
#include <unordered_set>

#include "services/slam/lib/map_motion.hpp"
#include "services/slam/lib/point_fusion.hpp"

namespace tsg {
namespace {

constexpr int kStrongLink = 100;         // shared points: such pairs hold each other well
constexpr double kSigmaMetres = 0.003;   // of the relative pose of two keyframes that are close
constexpr double kSigmaPerMetre = 0.01;  // and of those further apart
constexpr double kSigmaRadians = 0.001;
constexpr double kSigmaPerRadian = 0.01;
constexpr double kWeakLink = 0.2;    // weight of neighbours in time that share too little
constexpr double kJoinRadius = 8.0;  // pixels: the two sides fit each other within centimetres

using NodeOfKeyframe = std::unordered_map<KeyframeId, std::size_t>;

PoseGraph::Edge make_edge(std::size_t a, std::size_t b, const SE3& T_a_b, double trust) {
  return {
      .a = a,
      .b = b,
      .T_a_b = T_a_b,
      .translation_weight = trust / (kSigmaMetres + kSigmaPerMetre * T_a_b.translation().norm()),
      .rotation_weight = trust / (kSigmaRadians + kSigmaPerRadian * T_a_b.angle())};
}

/// Joins a keyframe with earlier ones: the one before it, and those that share many points.
void add_edges(const Map& map,
               const Keyframe& keyframe,
               const Keyframe* previous,
               const NodeOfKeyframe& nodes,
               PoseGraph& graph) {
  const std::size_t node = nodes.at(keyframe.id);
  const auto join = [&](const Keyframe& other, double trust) {
    const SE3 T_other_this = other.T_world_camera.inverse() * keyframe.T_world_camera;
    graph.edges.push_back(make_edge(nodes.at(other.id), node, T_other_this, trust));
  };
  bool has_previous = previous == nullptr;
  for (const Covisibility& neighbour : map.covisible_with(keyframe)) {
    if (neighbour.shared < kStrongLink) break;
    if (neighbour.keyframe > keyframe.id) continue;
    join(map.keyframe(neighbour.keyframe), 1.0);
    has_previous = has_previous || neighbour.keyframe == previous->id;
  }
  if (!has_previous) join(*previous, kWeakLink);
}

std::vector<KeyframeId> around(const Map& map, const MapperConfig& config, KeyframeId centre) {
  std::vector<KeyframeId> keyframes = {centre};
  for (const Covisibility& neighbour : map.covisible_with(map.keyframe(centre))) {
    if (neighbour.shared < config.min_shared_points) break;
    if (static_cast<int>(keyframes.size()) > config.window_keyframes) break;
    keyframes.push_back(neighbour.keyframe);
  }
  return keyframes;
}

std::vector<PointId> points_seen_by(const Map& map, const std::vector<KeyframeId>& keyframes) {
  std::vector<PointId> points;
  std::unordered_set<PointId> known = {kNoPoint};
  for (const KeyframeId id : keyframes) {
    for (const PointId point : map.keyframe(id).points) {
      if (known.insert(point).second) points.push_back(point);
    }
  }
  return points;
}

}  // namespace

PoseGraph build_essential_graph(const Map& map, const std::vector<LoopEdge>& loops, MapPart part) {
  PoseGraph graph;
  NodeOfKeyframe nodes;
  const Keyframe* previous = nullptr;
  for (const auto& [id, keyframe] : map.keyframes()) {
    if (keyframe.part != part) continue;
    nodes[id] = graph.nodes.size();
    graph.nodes.push_back({keyframe.T_world_camera, part_begun_by(id) == part});
    add_edges(map, keyframe, previous, nodes, graph);
    previous = &keyframe;
  }
  for (const LoopEdge& loop : loops) {
    if (!nodes.contains(loop.a)) continue;
    graph.edges.push_back(make_edge(nodes.at(loop.a), nodes.at(loop.b), loop.T_a_b, 1.0));
  }
  return graph;
}

bool correct_map(Map& map,
                 const ObservationModel& model,
                 const std::vector<LoopEdge>& loops,
                 MapPart part,
                 const std::function<bool()>& must_stop) {
  PoseGraph graph = build_essential_graph(map, loops, part);
  if (!relax(graph, must_stop)) return false;
  KeyframeTargets targets;
  std::size_t node = 0;
  for (const auto& [id, keyframe] : map.keyframes()) {
    if (keyframe.part == part) targets[id] = graph.nodes[node++].T_world_camera;
  }
  move_map(map, model, targets);
  return true;
}

void join_sides(Map& map,
                const ObservationModel& model,
                const MapperConfig& config,
                KeyframeId before,
                KeyframeId newest) {
  const std::vector<KeyframeId> new_side = around(map, config, newest);
  const std::vector<PointId> old_points = points_seen_by(map, around(map, config, before));
  for (const KeyframeId keyframe : new_side) {
    fuse_points_into(map, model, old_points, keyframe, kJoinRadius);
  }
  for (const PointId id : points_seen_by(map, new_side)) {
    map.update_appearance(*map.find_point(id), model);
  }
}

}  // namespace tsg
