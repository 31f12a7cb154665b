#include "services/map_server/lib/tags/tag_cells.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "services/map_server/lib/voxel_key.hpp"

namespace tsg {
namespace {

/// Standard deviation of the depth of a Kinect-class camera, noise and steps together, at 1 m;
/// grows with the square of the distance (Khoshelham and Elberink 2012: 0.0014 without steps).
constexpr float kNoiseAtOneMetre_m = 0.002F;

/// One step along each axis.
constexpr std::array<std::uint64_t, 3> kSteps{1, std::uint64_t{1} << kVoxelKeyBits,
                                              std::uint64_t{1} << (2 * kVoxelKeyBits)};

std::uint64_t key_of(const Eigen::Vector3f& position, double voxel_m) {
  std::uint64_t key = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const auto cell =
        static_cast<std::int64_t>(std::floor(static_cast<double>(position[axis]) / voxel_m));
    key |= (static_cast<std::uint64_t>(cell + kVoxelKeyOffset) & kVoxelKeyMask)
           << (static_cast<unsigned>(axis) * kVoxelKeyBits);
  }
  return key;
}

/// The key of the cell of twice the size that holds cell `key`.
std::uint64_t coarser(std::uint64_t key) {
  std::uint64_t coarse = 0;
  for (unsigned axis = 0; axis < 3; ++axis) {
    const auto cell =
        static_cast<std::int64_t>(key >> (axis * kVoxelKeyBits) & kVoxelKeyMask) - kVoxelKeyOffset;
    const std::int64_t half = (cell - (cell & 1)) / 2;
    coarse |= (static_cast<std::uint64_t>(half + kVoxelKeyOffset) & kVoxelKeyMask)
              << (axis * kVoxelKeyBits);
  }
  return coarse;
}

bool by_key(const TagCell& a, const TagCell& b) { return a.key < b.key; }

void absorb(TagCell& cell, const TagCell& more) {
  cell.weight += more.weight;
  const float share = static_cast<float>(more.weight) / static_cast<float>(cell.weight);
  cell.position += share * (more.position - cell.position);
  cell.colour += share * (more.colour - cell.colour);
  cell.depth_noise += share * (more.depth_noise - cell.depth_noise);
}

}  // namespace

TagCells::TagCells(double voxel_m, const Cloud& points, const Eigen::Vector3f& t_world_camera)
    : voxel_m_(voxel_m) {
  cells_.reserve(points.size());
  for (const CloudPoint& point : points) {
    const Eigen::Vector3f ray = point.position - t_world_camera;
    cells_.push_back({key_of(point.position, voxel_m),
                      point.position,
                      {static_cast<float>(point.colour.r), static_cast<float>(point.colour.g),
                       static_cast<float>(point.colour.b)},
                      kNoiseAtOneMetre_m * ray.norm() * ray,
                      point.weight,
                      1});
  }
  sort_and_join();
}

Eigen::AlignedBox3f TagCells::bounds() const {
  Eigen::AlignedBox3f box;
  for (const TagCell& cell : cells_) box.extend(cell.position);
  return box;
}

void TagCells::join(const TagCells& other) {
  while (voxel_m_ < other.voxel_m_) coarsen();
  if (other.voxel_m_ < voxel_m_) {
    TagCells as_coarse = other;
    while (as_coarse.voxel_m_ < voxel_m_) as_coarse.coarsen();
    return join(as_coarse);
  }
  std::vector<TagCell> joined;
  joined.reserve(cells_.size() + other.cells_.size());
  auto mine = cells_.begin();
  for (const TagCell& theirs : other.cells_) {
    while (mine != cells_.end() && mine->key < theirs.key) joined.push_back(*mine++);
    if (mine == cells_.end() || mine->key != theirs.key) {
      joined.push_back(theirs);
      continue;
    }
    joined.push_back(*mine++);
    absorb(joined.back(), theirs);
    joined.back().keyframes += theirs.keyframes;
  }
  joined.insert(joined.end(), mine, cells_.end());
  cells_ = std::move(joined);
}

void TagCells::coarsen() {
  voxel_m_ *= 2.0;
  for (TagCell& cell : cells_) cell.key = coarser(cell.key);
  sort_and_join();
}

void TagCells::remove_if(const std::function<bool(const TagCell&)>& is_bad) {
  std::erase_if(cells_, is_bad);
}

bool TagCells::is_near(const Eigen::Vector3f& position) const {
  const std::uint64_t key = key_of(position, voxel_m_);
  return find(key) != nullptr || std::any_of(kSteps.begin(), kSteps.end(), [&](std::uint64_t step) {
           return find(key + step) != nullptr || find(key - step) != nullptr;
         });
}

Cloud TagCells::to_cloud(ClassId class_id) const {
  Cloud cloud;
  cloud.reserve(cells_.size());
  for (const TagCell& cell : cells_) {
    const auto channel = [&cell](int i) {
      return static_cast<std::uint8_t>(std::lround(cell.colour[i]));
    };
    cloud.push_back({cell.position, {channel(0), channel(1), channel(2)}, class_id, cell.weight});
  }
  return cloud;
}

const TagCell* TagCells::at(const Eigen::Vector3f& position) const {
  return find(key_of(position, voxel_m_));
}

const TagCell* TagCells::find(std::uint64_t key) const {
  const auto found = std::lower_bound(cells_.begin(), cells_.end(), TagCell{.key = key}, by_key);
  return found != cells_.end() && found->key == key ? &*found : nullptr;
}

void TagCells::sort_and_join() {
  // Stable, so that sums do not depend on how the library sorts.
  std::stable_sort(cells_.begin(), cells_.end(), by_key);
  std::size_t last = 0;
  for (std::size_t i = 1; i < cells_.size(); ++i) {
    if (cells_[i].key == cells_[last].key) {
      absorb(cells_[last], cells_[i]);
      cells_[last].keyframes = std::max(cells_[last].keyframes, cells_[i].keyframes);
    } else {
      cells_[++last] = cells_[i];
    }
  }
  if (!cells_.empty()) cells_.resize(last + 1);
}

double share_within(const TagCells& part, const TagCells& whole, std::size_t samples) {
  if (part.empty() || whole.empty()) return 0.0;
  const std::size_t stride = 1 + (part.size() - 1) / samples;
  std::size_t looked_at = 0;
  std::size_t near = 0;
  for (std::size_t i = 0; i < part.size(); i += stride) {
    ++looked_at;
    near += whole.is_near(part.cells()[i].position) ? 1 : 0;
  }
  return static_cast<double>(near) / static_cast<double>(looked_at);
}

}  // namespace tsg
