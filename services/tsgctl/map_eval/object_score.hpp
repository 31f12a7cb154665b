#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "services/map_server/lib/tags/tag.hpp"
#include "services/tsgctl/scene_truth/scene_truth.hpp"

namespace tsg {

/// An object of the scene as a map should have it.
struct ExpectedObject {
  int id = 0;  ///< in truth_objects.json
  std::string class_name;
  std::string name;
  TrueBox box;                ///< where it stands at the end; from_ns: since when
  bool is_well_seen = false;  ///< in enough keyframes for a map to be blamed that lacks it
};

/// A tag and the object that it stands for.
struct TagMatch {
  int object_id = 0;
  std::string name;
  std::string class_name;
  std::uint32_t tag_id = 0;
  bool is_well_seen = false;
  double centre_error_m = 0.0;
  double size_error = 0.0;  ///< relative: length of the difference of the sizes, by the true size's
};

/// What a map knows of the objects of one class.
struct ClassScore {
  std::string class_name;
  std::size_t objects = 0;  ///< well seen
  std::size_t tags = 0;     ///< that stand where they were seen last
  std::size_t missing = 0;  ///< well seen, without a tag
  std::size_t surplus = 0;  ///< tags without an object

  [[nodiscard]] std::size_t count_error() const { return missing + surplus; }
};

struct ObjectScore {
  std::vector<ClassScore> classes;  ///< by name; those with an object or a tag
  std::vector<TagMatch> matches;

  [[nodiscard]] std::size_t count_error() const;  ///< of all classes together
};

/// Pairs tags with objects of the same class, the closest first, as far as the middle of a tag lies
/// within the object's box and 0.3 m around it. Tags of things that are gone do not count; an
/// object that is not well seen needs no tag and may have one.
[[nodiscard]] ObjectScore score_objects(std::span<const Tag> tags,
                                        const std::vector<ExpectedObject>& objects);

}  // namespace tsg
