#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "common/core/error.hpp"
#include "services/map_server/lib/class_table.hpp"
#include "services/map_server/lib/keyframe.hpp"
#include "services/map_server/lib/keyframe_view.hpp"
#include "services/map_server/lib/outlier_filter.hpp"
#include "services/map_server/lib/semantic_octree.hpp"
#include "services/map_server/lib/tags/tag_library.hpp"
#include "services/map_server/lib/voxel_grid.hpp"

namespace tsg {

struct MapConfig {
  DepthFilterConfig depth;
  ExclusionConfig exclusion;
  OutlierConfig outliers;
  OctreeConfig octree;
  TagConfig tags;
  double cloud_voxel_m = 0.02;  ///< as fine as the depth of a Kinect is good at 3 m
  double max_extent_m = 500.0;  ///< a camera farther from the origin is a mistake

  [[nodiscard]] std::vector<std::string> problems() const;
};

/// What one keyframe added.
struct Integration {
  std::size_t points_raw = 0;  ///< pixels that became points
  std::size_t points = 0;      ///< left of them by the voxel filter
};

/// A class of objects in the map.
struct ObjectClass {
  std::string name;
  int count = 0;           ///< that stand in the map now (TagLibrary)
  int max_in_view = 0;     ///< most instances in one keyframe: a lower bound of their number
  std::size_t leaves = 0;  ///< occupied leaves of this class
};

struct MapSummary {
  std::size_t keyframes = 0;
  std::size_t keyframes_without_labels = 0;  ///< of these; people in them were not left out
  std::size_t points_raw = 0;                ///< of all keyframes together
  std::size_t points = 0;                    ///< after voxel filter and loss of what is free now
  std::size_t leaves = 0;                    ///< occupied
  std::size_t leaves_free = 0;
  std::vector<ObjectClass> objects;  ///< by name
};

struct MapFiles {
  std::size_t points = 0;  ///< in cloud.ply
  std::size_t bytes_ot = 0;
  std::size_t bytes_bt = 0;
  std::size_t bytes_ply = 0;
};

/// The map of what stays put: a coloured cloud and a semantic octree, in the map frame, grown
/// keyframe by keyframe (paper, section 5). Deterministic: the same keyframes in the same order
/// give the same files. Owned by one thread.
class SemanticMap {
 public:
  explicit SemanticMap(const MapConfig& config);

  /// Adds a keyframe; one that is not sound is refused with the reason, and changes nothing.
  Expected<Integration> integrate(const MapKeyframe& keyframe);

  /// The cloud without points whose leaf has been seen free since: people who were missed fade.
  [[nodiscard]] Cloud occupied_cloud() const;
  /// The same without what lies apart from all else (OutlierFilter).
  [[nodiscard]] Cloud static_cloud() const;
  [[nodiscard]] const SemanticOctree& octree() const { return octree_; }
  [[nodiscard]] const ClassTable& classes() const { return classes_; }
  [[nodiscard]] const TagLibrary& tags() const { return tags_; }

  /// Goes through the whole map: for commands, not for every keyframe.
  [[nodiscard]] MapSummary summary() const;

  /// Writes map.ot, map.bt and cloud.ply, each complete or not at all; the folder is made where it
  /// is absent. kCannotWrite names the file, the bytes needed and the fix; older files stay.
  Expected<MapFiles> save(const std::filesystem::path& folder) const;

 private:
  /// Puts a view at its place (paper eq. 7).
  void add(const KeyframeView& view, const SE3& T_world_camera);
  void count_instances(const KeyframeView& view);

  MapConfig config_;
  ClassTable classes_;
  KeyframeViewer viewer_;
  VoxelGrid cloud_;
  SemanticOctree octree_;
  TagLibrary tags_;
  std::size_t keyframes_ = 0;
  std::size_t keyframes_without_labels_ = 0;
  std::size_t points_raw_ = 0;
  std::map<ClassId, int> max_in_view_;
};

}  // namespace tsg
