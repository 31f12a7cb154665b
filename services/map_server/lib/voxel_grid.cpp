#include "services/map_server/lib/voxel_grid.hpp"

#include "services/map_server/lib/voxel_key.hpp"

namespace tsg {
namespace {

constexpr std::size_t kFirstSlots = 1024;

/// Cells of one cube of 4 a side lie together, so that neighbours share cache lines; the cubes are
/// spread by the finaliser of MurmurHash3.
std::size_t hash(std::uint64_t key) {
  constexpr std::uint64_t kLowBits = 3U | 3ULL << kVoxelKeyBits | 3ULL << (2 * kVoxelKeyBits);
  const std::uint64_t within =
      (key & 3U) | (key >> (kVoxelKeyBits - 2) & 12U) | (key >> (2 * kVoxelKeyBits - 4) & 48U);
  std::uint64_t cube = key & ~kLowBits;
  cube ^= cube >> 33U;
  cube *= 0xff51afd7ed558ccdULL;
  cube ^= cube >> 33U;
  cube *= 0xc4ceb9fe1a85ec53ULL;
  cube ^= cube >> 33U;
  return static_cast<std::size_t>(cube << 6U | within);
}

/// For 0..255, where truncation rounds down; std::lround is a call into the C library.
std::uint8_t to_channel(float value) {
  const float half_up = value + 0.5F;
  return static_cast<std::uint8_t>(half_up);
}

/// std::floor without the call that it is on processors without SSE 4.1.
std::int64_t floor_of(double value) {
  const auto truncated = static_cast<std::int64_t>(value);
  return truncated - (value < static_cast<double>(truncated) ? 1 : 0);
}

}  // namespace

void ClassVote::add(ClassId id, std::uint32_t weight) {
  if (id == kNotSegmentedClass) return;
  if (id == winner_) {
    lead_ += weight;
  } else if (weight > lead_) {
    winner_ = id;
    lead_ = weight - lead_;
  } else {
    lead_ -= weight;
  }
}

VoxelGrid::VoxelGrid(double voxel_m) : cells_per_metre_(1.0 / voxel_m), slots_(kFirstSlots, 0) {}

void VoxelGrid::add(const CloudPoint& point) {
  Cell& cell = cell_with(key_of(point.position));
  cell.weight += point.weight;
  const float share = static_cast<float>(point.weight) / static_cast<float>(cell.weight);
  const Eigen::Vector3f colour(point.colour.r, point.colour.g, point.colour.b);
  cell.position += share * (point.position - cell.position);
  cell.colour += share * (colour - cell.colour);
  cell.vote.add(point.class_id, point.weight);
}

void VoxelGrid::clear() {
  cells_.clear();
  slots_.assign(slots_.size(), 0);
  last_ = 0;
}

Voxel VoxelGrid::voxel(std::size_t index) const {
  const Cell& cell = cells_[index];
  const auto axis = [&cell](int number) {
    const auto bits = (cell.key >> (number * kVoxelKeyBits)) & kVoxelKeyMask;
    return static_cast<int>(static_cast<std::int64_t>(bits) - kVoxelKeyOffset);
  };
  const Rgb colour{to_channel(cell.colour.x()), to_channel(cell.colour.y()),
                   to_channel(cell.colour.z())};
  return {{axis(0), axis(1), axis(2)}, {cell.position, colour, cell.vote.winner(), cell.weight}};
}

std::size_t VoxelGrid::index_of(const Eigen::Vector3f& position) const {
  return slots_[slot_of(key_of(position))] - 1;
}

Cloud VoxelGrid::to_cloud() const {
  Cloud cloud;
  cloud.reserve(size());
  for (std::size_t i = 0; i < size(); ++i) cloud.push_back(voxel(i).mean);
  return cloud;
}

std::uint64_t VoxelGrid::key_of(const Eigen::Vector3f& position) const {
  std::uint64_t key = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const std::int64_t cell = floor_of(cells_per_metre_ * static_cast<double>(position[axis]));
    const auto bits = static_cast<std::uint64_t>(cell + kVoxelKeyOffset);
    key |= (bits & kVoxelKeyMask) << static_cast<unsigned>(axis * kVoxelKeyBits);
  }
  return key;
}

VoxelGrid::Cell& VoxelGrid::cell_with(std::uint64_t key) {
  if (last_ < cells_.size() && cells_[last_].key == key) return cells_[last_];
  if (2 * (cells_.size() + 1) > slots_.size()) grow();
  const std::size_t slot = slot_of(key);
  if (slots_[slot] == 0) {
    cells_.push_back({});
    cells_.back().key = key;
    slots_[slot] = static_cast<std::uint32_t>(cells_.size());
  }
  last_ = slots_[slot] - 1;
  return cells_[last_];
}

std::size_t VoxelGrid::slot_of(std::uint64_t key) const {
  const std::size_t mask = slots_.size() - 1;
  std::size_t slot = hash(key) & mask;
  while (slots_[slot] != 0 && cells_[slots_[slot] - 1].key != key) slot = (slot + 1) & mask;
  return slot;
}

void VoxelGrid::grow() {
  slots_.assign(slots_.size() * 2, 0);
  const std::size_t mask = slots_.size() - 1;
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    std::size_t slot = hash(cells_[i].key) & mask;
    while (slots_[slot] != 0) slot = (slot + 1) & mask;
    slots_[slot] = static_cast<std::uint32_t>(i + 1);
  }
}

Cloud voxel_filter(const Cloud& cloud, VoxelGrid& grid) {
  grid.clear();
  for (const CloudPoint& point : cloud) grid.add(point);
  return grid.to_cloud();
}

}  // namespace tsg
