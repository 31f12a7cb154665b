#include "services/slam/lib/local_map_snapshot.hpp"

#include <algorithm>

namespace tsg {
namespace {

template <typename Item>
const Item* find_by_id(const std::vector<Item>& sorted, std::uint64_t id) {
  const auto found =
      std::lower_bound(sorted.begin(), sorted.end(), id,
                       [](const Item& item, std::uint64_t wanted) { return item.id < wanted; });
  return found != sorted.end() && found->id == id ? &*found : nullptr;
}

}  // namespace

const SnapshotKeyframe* LocalMapSnapshot::find_keyframe(KeyframeId id) const {
  return find_by_id(keyframes, id);
}

const SnapshotPoint* LocalMapSnapshot::find_point(PointId id) const {
  return find_by_id(points, id);
}

std::optional<KeyframeId> LocalMapSnapshot::keyframe_sharing_most(std::vector<PointId> seen) const {
  std::sort(seen.begin(), seen.end());
  std::optional<KeyframeId> best;
  std::ptrdiff_t most = 0;
  for (const SnapshotKeyframe& keyframe : keyframes) {
    const auto shared =
        std::count_if(keyframe.points.begin(), keyframe.points.end(), [&](PointId id) {
          return id != kNoPoint && std::binary_search(seen.begin(), seen.end(), id);
        });
    if (shared <= most) continue;
    most = shared;
    best = keyframe.id;
  }
  return best;
}

}  // namespace tsg
