#pragma once

#include <memory>
#include <optional>

#include "common/core/error.hpp"
#include "services/segmentation/lib/decoders/class_names.hpp"
#include "services/segmentation/lib/instance_decoder.hpp"
#include "services/segmentation/lib/model_description.hpp"

namespace tsg {

/// The decoder for networks of the layout that `model` has. Classes are called by `names`, or,
/// where there are none, as the model's metadata does. kUnsupportedModel, saying what was found and
/// what is supported, where the layout is unknown; the errors of class_names_of() and
/// check_class_count().
[[nodiscard]] Expected<std::unique_ptr<InstanceDecoder>> make_decoder(
    const ModelDescription& model,
    const DecoderConfig& config,
    const std::optional<ClassNames>& names);

}  // namespace tsg
