#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "common/core/error.hpp"
#include "common/geometry/stamped_pose.hpp"
#include "common/simulation/simulator.hpp"

namespace tsg {

/// When simulated sequences begin, UTC: any time will do, but always the same.
inline constexpr std::int64_t kSequenceStartNs = 1'700'000'000'000'000'000;

/// Writes what is true of the space of a scene beside the images of these frames
/// (write_scene_truth()); takes milliseconds for each frame with people. kCannotWrite.
[[nodiscard]] Expected<void> write_truth_of_scene(const simulation::Simulator& simulator,
                                                  const std::vector<int>& frames,
                                                  const std::filesystem::path& folder);

/// kCannotWrite where `folder` is there and holds something, or is no folder.
[[nodiscard]] Expected<void> check_new_folder(const std::filesystem::path& folder);

/// Writes simulated frames as a sequence in TUM layout, with true masks and exact poses. Lists and
/// truth come last: a folder without rgb.txt is one that was not finished. One thread owns it.
class SequenceWriter {
 public:
  /// Makes the folders; kCannotWrite where that fails; errors of check_new_folder().
  [[nodiscard]] static Expected<SequenceWriter> open(
      const std::filesystem::path& folder,
      const simulation::SensorDescription& sensor,
      std::vector<simulation::SimulatedInstance> instances);

  /// Writes the images of a frame; kCannotWrite.
  [[nodiscard]] Expected<void> add(const simulation::SimulatedFrame& frame);
  /// Writes rgb.txt, depth.txt, groundtruth.txt, camera.yaml and instances.json.
  [[nodiscard]] Expected<void> finish() const;

 private:
  SequenceWriter(std::filesystem::path folder,
                 const simulation::SensorDescription& sensor,
                 std::vector<simulation::SimulatedInstance> instances);
  [[nodiscard]] std::string list_of(const std::string& kind) const;
  [[nodiscard]] std::string camera_yaml() const;
  [[nodiscard]] std::string instances_json() const;

  std::filesystem::path folder_;
  simulation::SensorDescription sensor_;
  std::vector<simulation::SimulatedInstance> instances_;
  std::vector<std::string> stamps_;    ///< of the frames, as the files have them
  std::vector<std::set<int>> moving_;  ///< what moves, of the frames
  std::map<int, int> frames_visible_;  ///< by instance
  Trajectory truth_;
};

}  // namespace tsg
