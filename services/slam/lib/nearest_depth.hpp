#pragma once

namespace tsg {

/// Metres in front of the camera: what is nearer, or behind, is no measurement. No depth sensor in
/// use measures that near, and projections vary too much there.
inline constexpr float kMinDepth = 0.1F;

}  // namespace tsg
