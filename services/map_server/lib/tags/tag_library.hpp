#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "common/geometry/se3.hpp"
#include "services/map_server/lib/keyframe_view.hpp"
#include "services/map_server/lib/tags/tag.hpp"
#include "services/map_server/lib/tags/tag_config.hpp"
#include "services/map_server/lib/tags/tag_places.hpp"
#include "services/map_server/lib/tags/tag_record.hpp"

namespace tsg {

/// The semantic tag library: the objects of a map, grown keyframe by keyframe after the paper's
/// Algorithm 1, and kept up as they move (docs/decisions/0011-semantic-tags.md says what is added
/// and why). Deterministic. Owned by one thread.
class TagLibrary {
 public:
  explicit TagLibrary(const TagConfig& config) : config_(config) {}

  /// Takes in what a keyframe shows. `place_of` tells what was known of space before it.
  void add(const KeyframeView& view, const SE3& T_world_camera, const PlaceOf& place_of);

  /// The objects that are sure, by id; those that are gone too (see Tag::state). Valid until the
  /// library changes.
  [[nodiscard]] const std::vector<Tag>& tags() const;
  /// What may be a mistake of the segmentation so far, by id.
  [[nodiscard]] const std::vector<Tag>& tentative() const;

  /// Gives tags the ids that they have in `before`, a library of the same keyframes at other
  /// poses: the tags of both that most sightings have in common are the same object. No id that
  /// `before` gave is given again.
  void adopt_ids(const TagLibrary& before);

 private:
  [[nodiscard]] std::vector<SeenInstance> clean(const KeyframeView& view,
                                                const Eigen::Isometry3f& T_world_camera) const;
  void retract_moving(const KeyframeView& view);
  void fuse(std::size_t record, const SeenInstance& seen, const KeyframeView& view);
  void insert(const SeenInstance& seen, const KeyframeView& view, const PlaceOf& place_of);
  /// The tag that was at another place and is `seen` now, if that is sure.
  [[nodiscard]] TagRecord* find_moved(const SeenInstance& seen);
  void merge_with_others(std::uint32_t id);
  void check_places(const KeyframeView& view, const ViewVolume& volume, const PlaceOf& place_of);
  void check_place(TagRecord& record, const PlaceOf& place_of);
  void join_gone_with_appeared();
  void forget_oldest_glimpses();
  [[nodiscard]] bool is_sure(const TagRecord& record) const;
  [[nodiscard]] bool is_shadowed(const TagRecord& record) const;
  void list_tags() const;
  TagRecord* find(std::uint32_t id);

  TagConfig config_;
  std::vector<TagRecord> records_;  // by id
  std::uint32_t next_id_ = 1;
  std::uint64_t keyframes_ = 0;

  // Made when asked for: boxes of all tags after every keyframe would cost more than the rest.
  mutable bool is_listed_ = false;
  mutable std::vector<Tag> sure_;
  mutable std::vector<Tag> tentative_;
};

}  // namespace tsg
