#pragma once

#include <Eigen/Geometry>
#include <compare>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/rgbd/instances.hpp"
#include "services/map_server/lib/tags/tag.hpp"
#include "services/map_server/lib/tags/tag_cells.hpp"
#include "services/map_server/lib/tags/tag_shape.hpp"

namespace tsg {

/// An instance of one keyframe, cleaned and put at its place.
struct SeenInstance {
  std::uint32_t index = 0;  ///< in its keyframe
  const Instance* instance = nullptr;
  ClassId class_id = kBackgroundClass;
  TagCells cells;
  Eigen::AlignedBox3f box;
};

/// Which instance of which keyframe showed a tag.
struct Sighting {
  std::uint64_t keyframe = 0;
  std::uint32_t instance = 0;
  auto operator<=>(const Sighting&) const = default;
};

/// What the library knows of a tag.
struct TagRecord {
  std::uint32_t id = 0;
  std::string class_name;
  ClassId class_id = kBackgroundClass;
  TagCells cells;
  Eigen::AlignedBox3f box{};          ///< rough_box(cells)
  std::vector<Sighting> sightings{};  ///< ascending
  double score_sum = 0.0;
  double doubt = 1.0;  ///< that all sightings were mistakes: each is one with 1 - score / 2
  std::int64_t first_seen_ns = 0;
  std::int64_t last_seen_ns = 0;
  TagState state = TagState::kStatic;
  std::uint32_t track_id = 0;  ///< the latest; 0 where nobody follows instances
  bool has_moved = false;
  bool appeared = false;  ///< stands where the place had been seen free before
  int free_checks = 0;    ///< in a row that found its place free
  std::uint64_t last_check = 0;
  mutable std::optional<TagShape> shape{};  ///< of cells, once it was asked for
};

[[nodiscard]] inline bool is_present(const TagRecord& record) {
  return record.state != TagState::kGone;
}

/// Keyframes that showed both as two instances.
[[nodiscard]] int keyframes_in_common(const TagRecord& a, const TagRecord& b);

/// Fuses what one keyframe shows into a tag (line 7 of the paper's Algorithm 1).
void take_in(TagRecord& record,
             const SeenInstance& seen,
             std::uint64_t keyframe,
             std::int64_t stamp_ns);

/// Fuses `other` into `record`: two tags that are one object.
void take_in(TagRecord& record, const TagRecord& other);

/// Forgets where the object was, as it has moved; what it is and who saw it stays.
void put_elsewhere(TagRecord& record);

/// To be called when cells have changed: joins voxels until there are no more than `max_voxels`.
void finish_cells(TagRecord& record, std::size_t max_voxels);

}  // namespace tsg
