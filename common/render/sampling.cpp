#include "common/render/sampling.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace tsg::render {
namespace {

constexpr float kWholeTurn = 2.0F * std::numbers::pi_v<float>;

/// All bits of a number spread over all bits (Wellons' "lowbias32" constants).
std::uint32_t scrambled(std::uint32_t value) {
  value = (value ^ (value >> 16U)) * 0x7FEB352DU;
  value = (value ^ (value >> 15U)) * 0x846CA68BU;
  return value ^ (value >> 16U);
}

/// The bits in reverse order behind the binary point (van der Corput).
float radical_inverse(std::uint32_t bits) {
  bits = (bits << 16U) | (bits >> 16U);
  bits = ((bits & 0x55555555U) << 1U) | ((bits & 0xAAAAAAAAU) >> 1U);
  bits = ((bits & 0x33333333U) << 2U) | ((bits & 0xCCCCCCCCU) >> 2U);
  bits = ((bits & 0x0F0F0F0FU) << 4U) | ((bits & 0xF0F0F0F0U) >> 4U);
  bits = ((bits & 0x00FF00FFU) << 8U) | ((bits & 0xFF00FF00U) >> 8U);
  return static_cast<float>(bits >> 8U) * 0x1.0p-24F;
}

float fraction(float value) { return value - std::floor(value); }

}  // namespace

Eigen::Vector2f spread_point(int index, int count, std::uint32_t salt) {
  const std::uint32_t shift_u = scrambled(2 * salt + 1);
  const std::uint32_t shift_v = scrambled(2 * salt + 2);
  const float u = (static_cast<float>(index) + 0.5F) / static_cast<float>(count);
  return {fraction(u + static_cast<float>(shift_u >> 8U) * 0x1.0p-24F),
          fraction(radical_inverse(static_cast<std::uint32_t>(index)) +
                   static_cast<float>(shift_v >> 8U) * 0x1.0p-24F)};
}

Eigen::Vector3f cosine_direction(const Eigen::Vector3f& normal, const Eigen::Vector2f& where) {
  const Eigen::Vector3f tangent = normal.unitOrthogonal();
  const Eigen::Vector3f bitangent = normal.cross(tangent);
  const float radius = std::sqrt(where.x());
  const float angle = kWholeTurn * where.y();
  return radius * std::cos(angle) * tangent + radius * std::sin(angle) * bitangent +
         std::sqrt(std::max(0.0F, 1.0F - where.x())) * normal;
}

Eigen::Vector3f sphere_direction(const Eigen::Vector2f& where) {
  const float z = 1.0F - 2.0F * where.x();
  const float radius = std::sqrt(std::max(0.0F, 1.0F - z * z));
  const float angle = kWholeTurn * where.y();
  return {radius * std::cos(angle), radius * std::sin(angle), z};
}

}  // namespace tsg::render
