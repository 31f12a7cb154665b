#pragma once

#include "services/map_server/lib/cloud.hpp"

namespace tsg {

/// The points of one instance (camera axes, metres) without what does not belong to it: masks
/// reach over rims onto what lies behind. Points are joined where they lie near each other, the
/// more generously the farther away, as depth gets coarser; the biggest piece stays, and so do
/// others of some size at its depth (a table behind a chair comes in two pieces).
[[nodiscard]] Cloud clean_instance(const Cloud& points);

}  // namespace tsg
