#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "common/core/error.hpp"
#include "common/dataset/instance_truth.hpp"
#include "common/dataset/tum_folder.hpp"
#include "common/geometry/stamped_pose.hpp"
#include "services/slam/lib/dynamic/frame_verdicts.hpp"
#include "services/slam/lib/slam_config.hpp"

namespace tsg {

/// Where the poses of the keyframes come from.
enum class PoseSource {
  kTruth,  ///< groundtruth.txt
  kFile,   ///< a trajectory file
  kSlam,   ///< slam itself, run over the sequence with its true masks
};

/// A frame of the sequence that goes into the map.
struct PlannedKeyframe {
  std::size_t frame = 0;           ///< index in the sequence
  SE3 T_world_camera;              ///< in the world of groundtruth.txt where there is one
  InstanceSegmentation instances;  ///< with verdicts; views of its own memory
  std::vector<int> ids;            ///< of instances.instances in instances.json
};

struct MapSequenceOptions {
  std::filesystem::path folder;
  PoseSource poses = PoseSource::kTruth;
  std::filesystem::path trajectory;  ///< of kFile
  std::size_t every_frames = 10;     ///< where slam does not choose the keyframes
  SlamConfig slam = {};              ///< of kSlam
};

/// A sequence with the keyframes that a map is made of.
struct MapSequence {
  TumFolder folder;
  std::vector<PlannedKeyframe> keyframes;
};

/// Chooses keyframes: every so many frames that have a pose; with kSlam those of tracking, with
/// poses as corrected at the end and verdicts by slam's own tracks. Trajectories that are not the
/// truth are aligned with it where there is one. Throws FatalError: kMissingInput where folder,
/// masks or poses are absent, kEmptyInput where no frame has a pose.
[[nodiscard]] MapSequence plan_keyframes(
    const MapSequenceOptions& options,
    const std::function<void(std::size_t done, std::size_t total)>& on_frame);

/// `mask` with what slam believes of the motion of its instances: those of the same class whose
/// boxes overlap most, by half at least; kUnknown where slam follows none there.
[[nodiscard]] InstanceSegmentation with_verdicts(InstanceSegmentation mask,
                                                 const FrameVerdicts& verdicts);

}  // namespace tsg
