#pragma once

#include <memory>

#include "services/camera/config.hpp"
#include "services/camera/lib/frame_source.hpp"

namespace tsg {

/// The source that the configuration names. Throws FatalError where it cannot be opened: the errors
/// of ReplaySource::open(), SceneLibrary::find() and load_scene().
[[nodiscard]] std::unique_ptr<FrameSource> open_source(const CameraConfig& config);

}  // namespace tsg
