#pragma once

#include <span>
#include <string>
#include <string_view>

#include "services/slam/offline/mask_source.hpp"

namespace tsg {

/// Masks that are worse than those which the sequence has, as a segmentation may give them.
struct RunVariant {
  std::string_view name;  ///< on the command line
  std::string_view text;  ///< in reports
  MaskOptions masks;
};

/// All that there are.
[[nodiscard]] std::span<const RunVariant> run_variants();

/// kUsage, naming those that there are, for a name that is none.
[[nodiscard]] Expected<const RunVariant*> find_variant(std::string_view name);

}  // namespace tsg
