#pragma once

#include <string>

#include "common/app/config_file.hpp"
#include "common/rgbd/mask_faults.hpp"

namespace tsg {

/// Overwrites what the section of `reader` has under `prefix`, e.g. "faults.", and its members'
/// names. The caller adds faults.problems() to reader.finish().
void read_mask_faults(ConfigReader& reader, const std::string& prefix, MaskFaults& faults);

}  // namespace tsg
