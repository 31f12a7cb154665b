#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

namespace tsg {

/// How features on moving things are found. The first four are there to compare with.
enum class DynamicMethod : std::uint8_t {
  kNone,      ///< not at all: robust estimation alone
  kMask,      ///< instances of dynamic classes are dropped, whatever they do
  kEpipolar,  ///< distance from the epipolar line, fundamental matrix from all matches
  kTsg,       ///< the paper's coupling: that matrix from matches of static classes alone (4.3)
  kFull,      ///< classes, geometry in depth, and evidence of each instance over time
};

inline constexpr std::array<std::string_view, 5> kDynamicMethodNames{"none", "mask", "epipolar",
                                                                     "tsg", "full"};

[[nodiscard]] constexpr std::string_view name_of(DynamicMethod method) {
  return kDynamicMethodNames[static_cast<std::size_t>(method)];
}

/// Whether instance masks have a part in it.
[[nodiscard]] constexpr bool uses_masks(DynamicMethod method) {
  return method != DynamicMethod::kNone && method != DynamicMethod::kEpipolar;
}

/// Nothing for a name that is not one of kDynamicMethodNames.
[[nodiscard]] constexpr std::optional<DynamicMethod> method_named(std::string_view name) {
  for (std::size_t i = 0; i < kDynamicMethodNames.size(); ++i) {
    if (kDynamicMethodNames[i] == name) return static_cast<DynamicMethod>(i);
  }
  return std::nullopt;
}

}  // namespace tsg
