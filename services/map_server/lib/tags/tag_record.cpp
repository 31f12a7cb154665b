#include "services/map_server/lib/tags/tag_record.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

namespace tsg {

int keyframes_in_common(const TagRecord& a, const TagRecord& b) {
  int common = 0;
  auto in_b = b.sightings.begin();
  for (const Sighting& sighting : a.sightings) {
    while (in_b != b.sightings.end() && in_b->keyframe < sighting.keyframe) ++in_b;
    if (in_b == b.sightings.end()) break;
    common += in_b->keyframe == sighting.keyframe ? 1 : 0;
  }
  return common;
}

void take_in(TagRecord& record,
             const SeenInstance& seen,
             std::uint64_t keyframe,
             std::int64_t stamp_ns) {
  record.cells.join(seen.cells);
  const Sighting sighting{keyframe, seen.index};
  record.sightings.insert(
      std::upper_bound(record.sightings.begin(), record.sightings.end(), sighting), sighting);
  const double score = std::clamp(static_cast<double>(seen.instance->score), 0.0, 1.0);
  record.score_sum += score;
  record.doubt *= 1.0 - 0.5 * score;
  record.last_seen_ns = std::max(record.last_seen_ns, stamp_ns);
  if (seen.instance->track_id != 0) record.track_id = seen.instance->track_id;
  record.free_checks = 0;
}

void take_in(TagRecord& record, const TagRecord& other) {
  record.cells.join(other.cells);
  std::vector<Sighting> all;
  std::merge(record.sightings.begin(), record.sightings.end(), other.sightings.begin(),
             other.sightings.end(), std::back_inserter(all));
  record.sightings = std::move(all);
  record.score_sum += other.score_sum;
  record.doubt *= other.doubt;
  record.first_seen_ns = std::min(record.first_seen_ns, other.first_seen_ns);
  if (other.last_seen_ns >= record.last_seen_ns && other.track_id != 0) {
    record.track_id = other.track_id;
  }
  record.last_seen_ns = std::max(record.last_seen_ns, other.last_seen_ns);
  record.free_checks = 0;
}

void put_elsewhere(TagRecord& record) {
  record.state = TagState::kMoved;
  record.has_moved = true;
  record.cells.remove_if([](const TagCell&) { return true; });
  record.box.setEmpty();
}

void finish_cells(TagRecord& record, std::size_t max_voxels) {
  while (record.cells.size() > max_voxels) record.cells.coarsen();
  record.box = rough_box(record.cells);
  record.shape.reset();
}

}  // namespace tsg
