#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "services/map_server/lib/cloud.hpp"

namespace tsg {

/// A voxel of a tag: the mean of what fell into it, and how often it was seen.
struct TagCell {
  std::uint64_t key = 0;
  Eigen::Vector3f position = Eigen::Vector3f::Zero();  ///< metres, map frame
  Eigen::Vector3f colour = Eigen::Vector3f::Zero();    ///< red, green, blue; 0..255
  /// Mean over its points of the depth's standard deviation, in metres along the ray.
  Eigen::Vector3f depth_noise = Eigen::Vector3f::Zero();
  std::uint32_t weight = 0;     ///< points
  std::uint32_t keyframes = 0;  ///< that have a point here
};

/// The cloud of a tag: voxels in the order of their keys, so that clouds are joined and compared by
/// walking along both. Coordinates must lie within +-2^20 voxels.
class TagCells {
 public:
  explicit TagCells(double voxel_m) : voxel_m_(voxel_m) {}
  /// The voxels of one keyframe's points (map frame), seen from `t_world_camera`.
  TagCells(double voxel_m, const Cloud& points, const Eigen::Vector3f& t_world_camera);

  [[nodiscard]] bool empty() const { return cells_.empty(); }
  [[nodiscard]] std::size_t size() const { return cells_.size(); }
  [[nodiscard]] double voxel_m() const { return voxel_m_; }
  [[nodiscard]] const std::vector<TagCell>& cells() const { return cells_; }
  [[nodiscard]] Eigen::AlignedBox3f bounds() const;

  /// Takes in `other`; voxels become those of the coarser of both.
  void join(const TagCells& other);
  /// Voxels of twice the size.
  void coarsen();
  void remove_if(const std::function<bool(const TagCell&)>& is_bad);
  /// The voxel that holds `position`; null where it is empty.
  [[nodiscard]] const TagCell* at(const Eigen::Vector3f& position) const;
  /// Whether the voxel that holds `position`, or one that shares a face with it, is occupied.
  [[nodiscard]] bool is_near(const Eigen::Vector3f& position) const;
  [[nodiscard]] Cloud to_cloud(ClassId class_id) const;

 private:
  [[nodiscard]] const TagCell* find(std::uint64_t key) const;
  void sort_and_join();

  double voxel_m_;
  std::vector<TagCell> cells_;
};

/// Voxels of a cloud that overlaps are measured by: good to 3 %.
inline constexpr std::size_t kOverlapSamples = 200;

/// The share of the voxels of `part` near which `whole` has some, from at most `samples` of them;
/// 0 where either is empty.
[[nodiscard]] double share_within(const TagCells& part, const TagCells& whole, std::size_t samples);

}  // namespace tsg
