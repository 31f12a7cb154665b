#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "services/map_server/lib/tags/tag_config.hpp"
#include "services/map_server/lib/tags/tag_record.hpp"

namespace tsg {

/// d_min < d_w: the centres of two boxes are nearer to each other than the boxes are wide on
/// average. Wide is the longer of the two sides on the ground.
[[nodiscard]] bool are_centres_near(const Eigen::AlignedBox3f& a, const Eigen::AlignedBox3f& b);

/// How well `seen` fits a tag of its class, the more the better; nothing where it is another
/// object.
[[nodiscard]] std::optional<double> fit(const SeenInstance& seen,
                                        const TagRecord& record,
                                        const TagConfig& config);

/// Whether two tags are one object by now: they overlap and are not seen side by side.
[[nodiscard]] bool are_one_object(const TagRecord& a, const TagRecord& b, const TagConfig& config);

/// For each instance of a keyframe the tag that it shows, if any: the best fits first, no tag
/// twice, as two masks of one keyframe are two objects.
[[nodiscard]] std::vector<std::optional<std::size_t>> match(const std::vector<SeenInstance>& seen,
                                                            const std::vector<TagRecord>& records,
                                                            const TagConfig& config);

}  // namespace tsg
