#pragma once

#include <cstdint>
#include <deque>
#include <optional>

#include "common/core/error.hpp"
#include "common/dataset/instance_truth.hpp"
#include "common/dataset/tum_folder.hpp"

namespace tsg {

/// Which masks come with a recorded sequence, and how late.
struct MaskOptions {
  bool use = true;       ///< the sequence's true masks, where it has some
  int delay_frames = 0;  ///< a mask comes that many frames after its frame ...
  int every_frames = 1;  ///< ... and only every so many frames is segmented at all
};

/// Hands out the true masks of a sequence as a segmentation process would: late and seldom.
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
  explicit MaskSource(const MaskOptions& options) : options_(options) {}

  MaskOptions options_;
  std::optional<InstanceTruth> truth_;
  std::deque<InstanceSegmentation> pending_;
  std::optional<InstanceSegmentation> latest_;
};

}  // namespace tsg
