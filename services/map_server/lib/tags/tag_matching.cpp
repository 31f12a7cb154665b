#include "services/map_server/lib/tags/tag_matching.hpp"

#include <algorithm>
#include <tuple>

namespace tsg {
namespace {

/// The other side of a thing does not make it wider; a neighbour does.
constexpr float kSameWidth = 1.2F;
/// Boxes of neighbours do not share so much of the smaller one; those of parts of one thing may.
constexpr float kBoxShare = 0.15F;
/// Boxes are looked at that come nearer to each other than this.
constexpr float kReach_m = 0.05F;
/// What following an instance from mask to mask, and equal centres, count beside the overlap.
constexpr double kTrackBonus = 0.5;
constexpr double kCentreBonus = 0.5;
/// Two tags that so many of their keyframes show side by side are two objects.
constexpr double kSideBySideShare = 0.2;

float width(const Eigen::AlignedBox3f& box) { return std::max(box.sizes().x(), box.sizes().y()); }

float mean_width(const Eigen::AlignedBox3f& a, const Eigen::AlignedBox3f& b) {
  return 0.5F * (width(a) + width(b));
}

float distance(const Eigen::AlignedBox3f& a, const Eigen::AlignedBox3f& b) {
  return (a.center() - b.center()).norm();
}

bool touch(const Eigen::AlignedBox3f& a, const Eigen::AlignedBox3f& b) {
  return a.squaredExteriorDistance(b) < kReach_m * kReach_m;
}

bool is_as_wide_together(const Eigen::AlignedBox3f& a, const Eigen::AlignedBox3f& b) {
  return width(a.merged(b)) <= kSameWidth * std::max(width(a), width(b));
}

/// Share of the smaller box that lies within the other.
float box_share(const Eigen::AlignedBox3f& a, const Eigen::AlignedBox3f& b) {
  const Eigen::AlignedBox3f both = a.intersection(b);
  if (both.isEmpty()) return 0.0F;
  return both.volume() / std::max(1e-6F, std::min(a.volume(), b.volume()));
}

double overlap(const TagCells& a, const TagCells& b) {
  return std::max(share_within(a, b, kOverlapSamples), share_within(b, a, kOverlapSamples));
}

bool is_followed(const SeenInstance& seen, const TagRecord& record) {
  return seen.instance->track_id != 0 && seen.instance->track_id == record.track_id;
}

struct Pair {
  double fit;
  std::size_t seen;
  std::size_t record;
};

}  // namespace

bool are_centres_near(const Eigen::AlignedBox3f& a, const Eigen::AlignedBox3f& b) {
  return distance(a, b) < mean_width(a, b);
}

std::optional<double> fit(const SeenInstance& seen,
                          const TagRecord& record,
                          const TagConfig& config) {
  if (record.cells.empty() || record.class_name != seen.instance->class_name) return std::nullopt;
  const bool is_near = are_centres_near(seen.box, record.box);
  if (!is_near && !touch(seen.box, record.box)) return std::nullopt;
  const double shared = overlap(seen.cells, record.cells);
  const bool is_known = is_followed(seen, record);
  const bool is_other_side = is_near && (is_known || is_as_wide_together(seen.box, record.box));
  const bool shares_place =
      shared >= config.min_overlap || box_share(seen.box, record.box) >= kBoxShare;
  const bool fits = shared >= config.sure_overlap || (is_near && shares_place) || is_other_side;
  if (!fits) return std::nullopt;
  const double off_centre =
      std::min(1.0F, distance(seen.box, record.box) / mean_width(seen.box, record.box));
  return shared + kCentreBonus * (1.0 - off_centre) + (is_known ? kTrackBonus : 0.0);
}

bool are_one_object(const TagRecord& a, const TagRecord& b, const TagConfig& config) {
  if (a.class_name != b.class_name || !touch(a.box, b.box)) return false;
  const auto fewest = static_cast<double>(std::min(a.sightings.size(), b.sightings.size()));
  const int side_by_side = keyframes_in_common(a, b);
  if (side_by_side > kSideBySideShare * fewest) return false;
  if (overlap(a.cells, b.cells) >= config.merge_overlap) return true;
  // Parts of one thing that were never seen together, one below the other behind a desk.
  return side_by_side == 0 && fewest >= config.min_observations && are_centres_near(a.box, b.box) &&
         box_share(a.box, b.box) >= kBoxShare;
}

std::vector<std::optional<std::size_t>> match(const std::vector<SeenInstance>& seen,
                                              const std::vector<TagRecord>& records,
                                              const TagConfig& config) {
  std::vector<Pair> pairs;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    for (std::size_t k = 0; k < records.size(); ++k) {
      if (const auto how_well = fit(seen[i], records[k], config))
        pairs.push_back({*how_well, i, k});
    }
  }
  std::sort(pairs.begin(), pairs.end(), [](const Pair& a, const Pair& b) {
    return std::tuple(-a.fit, a.seen, a.record) < std::tuple(-b.fit, b.seen, b.record);
  });
  std::vector<std::optional<std::size_t>> record_of(seen.size());
  std::vector<bool> is_taken(records.size(), false);
  for (const Pair& pair : pairs) {
    if (record_of[pair.seen] || is_taken[pair.record]) continue;
    record_of[pair.seen] = pair.record;
    is_taken[pair.record] = true;
  }
  return record_of;
}

}  // namespace tsg
