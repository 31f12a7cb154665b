#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "services/map_server/lib/class_table.hpp"

namespace tsg {

/// One coloured, labelled point, or the mean of `weight` of them.
struct CloudPoint {
  Eigen::Vector3f position;  ///< metres; the cloud says in which frame
  Rgb colour;
  ClassId class_id = kBackgroundClass;
  std::uint32_t weight = 1;
};

using Cloud = std::vector<CloudPoint>;

}  // namespace tsg
