#pragma once

#include <cmath>

namespace tsg {

/// The probability that a network means by `logit`.
[[nodiscard]] inline float sigmoid(float logit) { return 1.0F / (1.0F + std::exp(-logit)); }

}  // namespace tsg
