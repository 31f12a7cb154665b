#pragma once

#include <atomic>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>

#include "common/core/error.hpp"
#include "common/dataset/instance_truth.hpp"
#include "services/segmentation/lib/segmentation_provider.hpp"

namespace tsg {

/// True instances of a rendered sequence, by the frame's stamp: what a perfect network would find.
/// Each thing's track_id is its id in the sequence. What that knows about motion is not passed on,
/// since to find that out is the task of whoever reads the masks.
class DatasetProvider final : public SegmentationProvider {
 public:
  /// `folder` holds mask/ and instances.json; the errors of InstanceTruth::open().
  static Expected<std::unique_ptr<SegmentationProvider>> make(const std::filesystem::path& folder);

  /// kMissingInput where the folder has no mask for the frame's stamp, kSizeMismatch where its
  /// mask is of another size, kBadData for a damaged one. Of more than kMaxInstances the biggest
  /// stay.
  [[nodiscard]] Expected<SegmentationResult> segment(const RgbdFrame& frame,
                                                     cv::Mat& labels) override;
  void cancel() override { is_cancelled_ = true; }
  [[nodiscard]] const std::string& name() const override { return name_; }
  [[nodiscard]] ProviderState state() override { return {}; }

 private:
  explicit DatasetProvider(InstanceTruth truth) : truth_(std::move(truth)) {}

  InstanceTruth truth_;
  std::string name_ = "dataset";
  std::atomic<bool> is_cancelled_ = false;
};

}  // namespace tsg
