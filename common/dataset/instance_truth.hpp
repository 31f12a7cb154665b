#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "common/core/error.hpp"
#include "common/dataset/association.hpp"
#include "common/dataset/tum_folder.hpp"
#include "common/rgbd/instances.hpp"

namespace tsg {

/// What instances.json says of one object.
struct KnownInstance {
  std::string class_name;  ///< COCO class
  std::string name;
  bool is_dynamic = false;              ///< moves at some time in the sequence
  std::map<std::int64_t, bool> moving;  ///< whether it moves, by stamp; for dynamic ones
};

/// The instances in view at one moment, each with its id in instances.json.
struct TrueMask {
  InstanceSegmentation segmentation;
  std::vector<int> ids;  ///< of segmentation.instances, one by one
};

/// True instance masks of a rendered sequence: mask/STAMP.png holds ids (0 = background), and
/// instances.json tells what they are.
class InstanceTruth {
 public:
  /// kMissingInput where mask/ or instances.json are absent, kEmptyInput for no mask, kBadData for
  /// a file that is not what it should be.
  [[nodiscard]] static Expected<InstanceTruth> open(const std::filesystem::path& folder);

  [[nodiscard]] const std::map<int, KnownInstance>& instances() const { return instances_; }

  /// The instances in view at a stamp, from the mask closest in time; kMissingInput where none is
  /// within `max_difference_ns`. Ids that instances.json does not know count as background; of
  /// more than kMaxInstances the biggest stay. Memory of labels is the caller's.
  [[nodiscard]] Expected<InstanceSegmentation> at(
      std::int64_t stamp_ns, std::int64_t max_difference_ns = kDefaultMaxDifferenceNs) const;

  /// The same, telling which is which from frame to frame.
  [[nodiscard]] Expected<TrueMask> mask_at(
      std::int64_t stamp_ns, std::int64_t max_difference_ns = kDefaultMaxDifferenceNs) const;

 private:
  InstanceTruth() = default;

  std::filesystem::path folder_;
  std::vector<ListedImage> masks_;  ///< by time
  std::map<int, KnownInstance> instances_;
};

}  // namespace tsg
