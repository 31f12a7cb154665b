#pragma once

#include <memory>

#include "common/core/error.hpp"
#include "services/segmentation/config.hpp"
#include "services/segmentation/lib/segmentation_provider.hpp"

namespace tsg {

/// The provider, "dataset" or "model", that `config` names. kConfig where what it needs is not set;
/// the errors of DatasetProvider::make() and ModelProvider::make().
[[nodiscard]] Expected<std::unique_ptr<SegmentationProvider>> make_provider(
    const SegmentationConfig& config);

}  // namespace tsg
