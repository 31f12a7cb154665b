#include "services/segmentation/lib/decoders/finite.hpp"

#include <bit>
#include <cstdint>

namespace tsg {

Expected<void> check_finite(std::span<const float> output) {
  constexpr std::uint32_t kExponent = 0x7F800000U;  // NaN and infinity have all of its bits
  std::uint32_t found = 0;
  for (const float value : output) {
    found |=
        static_cast<std::uint32_t>((std::bit_cast<std::uint32_t>(value) & kExponent) == kExponent);
  }
  if (found == 0) return {};
  return make_error(ExitCode::kInvalidNumber,
                    "the network's outputs hold NaN or infinity: the model file is damaged or was "
                    "exported in too low a precision; export it anew as float32");
}

}  // namespace tsg
