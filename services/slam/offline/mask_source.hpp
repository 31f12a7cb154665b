#pragma once

#include <cstdint>
#include <optional>

#include "common/core/error.hpp"
#include "common/dataset/instance_truth.hpp"
#include "common/dataset/tum_folder.hpp"
#include "common/rgbd/frame_delay.hpp"
#include "common/rgbd/mask_faults.hpp"

namespace tsg {

/// Which masks come with a recorded sequence.
struct MaskOptions {
  bool use = true;  ///< the sequence's true masks, where it has some
  MaskFaults faults = {};
};

/// Hands out the true masks of a sequence as a segmentation process would: late, seldom and wrong.
class MaskSource {
 public:
  /// Without masks, and no error, where the sequence has none; errors are InstanceTruth's.
  [[nodiscard]] static Expected<MaskSource> open(const std::filesystem::path& folder,
                                                 const MaskOptions& options);

  /// The latest mask that has come by the time of `frame`; null before the first. Call once for
  /// each frame, in their order. `recorded_ns` is the frame's stamp in the sequence's files. The
  /// mask stays valid until the next call.
  [[nodiscard]] Expected<const InstanceSegmentation*> latest(const RgbdFrame& frame,
                                                             std::int64_t recorded_ns);

 private:
  explicit MaskSource(const MaskFaults& faults) : faults_(faults), delayed_(faults.late_frames) {}

  std::optional<InstanceTruth> truth_;
  MaskFaultInjector faults_;
  FrameDelay<InstanceSegmentation> delayed_;
  std::optional<InstanceSegmentation> latest_;
};

}  // namespace tsg
