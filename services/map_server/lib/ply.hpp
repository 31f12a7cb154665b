#pragma once

#include <string>

#include "services/map_server/lib/class_table.hpp"
#include "services/map_server/lib/cloud.hpp"

namespace tsg {

/// The cloud as a binary little-endian PLY file: x y z (float, metres), red green blue (uchar),
/// class (uchar; 0 = background or unknown). Comments in its header name the classes in use, with
/// their colours.
[[nodiscard]] std::string to_ply(const Cloud& cloud, const ClassTable& classes);

}  // namespace tsg
