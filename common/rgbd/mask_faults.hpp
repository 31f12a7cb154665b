#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/rgbd/instances.hpp"

namespace tsg {

/// What is done to masks on purpose, to measure what becomes of poses when segmentation is late or
/// wrong. All off by default. "Every n-th": 0 = never, 1 = each.
struct MaskFaults {
  int late_frames = 0;   ///< a mask comes that many frames after its frame
  int every_frames = 1;  ///< only frames whose seq is a multiple are segmented; 10: 3 of 30 Hz
  int drop_every = 0;    ///< every n-th mask is missing altogether
  int drop_instance_every = 0;  ///< every n-th mask lacks one instance, each in turn
  bool merge_two =
      false;  ///< the two that touch most, else the nearest, become one of the bigger's class
  int shrink_px = 0;         ///< all instances are too small by so many pixels at each edge
  int swap_class_every = 0;  ///< in every n-th mask one instance, each in turn, has a wrong class

  [[nodiscard]] bool any() const;
  /// Each starts with the name of the member.
  [[nodiscard]] std::vector<std::string> problems() const;
};

/// The faults that are on, as in "late_frames=6, merge_two=true"; empty: none.
[[nodiscard]] std::string to_text(const MaskFaults& faults);

/// Applies faults to a stream of masks, mask by mask; being late is FrameDelay's part. The same
/// masks give the same faults.
class MaskFaultInjector {
 public:
  /// `faults` without problems.
  explicit MaskFaultInjector(const MaskFaults& faults) : faults_(faults) {}

  /// Whether frame `seq` is segmented at all.
  [[nodiscard]] bool is_segmented(std::uint64_t seq) const;

  /// The mask as it is to be seen; nothing where it is missing. Without any fault `mask` itself;
  /// else the labels are a copy, which lasts, and those of `mask` stay as they are.
  [[nodiscard]] std::optional<InstanceSegmentation> apply(InstanceSegmentation mask);

 private:
  MaskFaults faults_;
  std::uint64_t masks_ = 0;
  std::uint64_t dropped_instances_ = 0;
  std::uint64_t swapped_classes_ = 0;
};

}  // namespace tsg
