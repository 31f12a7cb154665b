#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "common/core/error.hpp"
#include "services/tsgctl/scene_truth/voxel_set.hpp"

namespace tsg {

/// An upright box in the world of groundtruth.txt, metres.
struct TrueBox {
  std::int64_t from_ns = 0;  ///< the frame from which on the object stands there
  Eigen::Vector3f centre_m = Eigen::Vector3f::Zero();
  Eigen::Vector3f size_m = Eigen::Vector3f::Zero();  ///< along its own axes; z is up
  float yaw_rad = 0.0F;                              ///< of its x axis
};

/// A thing of a rendered scene that is no person.
struct TrueObject {
  int id = 0;  ///< in mask/ and instances.json
  std::string class_name;
  std::string name;
  std::vector<TrueBox> boxes;  ///< by time; one where it never moves, else one for each new place

  /// Where it is at a time; the first box before that one begins.
  [[nodiscard]] const TrueBox& box_at(std::int64_t stamp_ns) const;
};

/// What is true of the space of a rendered scene, in the world of groundtruth.txt.
struct SceneTruth {
  static constexpr double kVoxelM = 0.05;

  std::vector<TrueObject> objects;
  VoxelSet swept_by_people{kVoxelM};  ///< filled by a body in at least one frame
  /// The building's surfaces and those of all things but people, wherever they were in a frame.
  VoxelSet surfaces{kVoxelM};
};

/// Whether the folder tells the truth of the space: sequences that other programs made do not.
[[nodiscard]] bool has_scene_truth(const std::filesystem::path& folder);

/// Writes truth_objects.json, truth_people.bt and truth_surfaces.bt; kCannotWrite.
[[nodiscard]] Expected<void> write_scene_truth(const std::filesystem::path& folder,
                                               SceneTruth& truth);

/// Reads them. kMissingInput names the file that is absent, kBadData the one that is damaged.
[[nodiscard]] Expected<SceneTruth> read_scene_truth(const std::filesystem::path& folder);

}  // namespace tsg
