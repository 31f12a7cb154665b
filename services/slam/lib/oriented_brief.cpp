#include "services/slam/lib/oriented_brief.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <random>

namespace tsg {
namespace {

constexpr int kTests = 256;
constexpr int kDirections = 64;  // steps of 5.6 degrees, well within what BRIEF tolerates
constexpr double kPatternSigma =
    5.8;  // pixels; isotropic normal pairs, the best of Calonder et al.
constexpr double kMinSeparation = 3.0;       // pixels; closer pairs compare little but noise
constexpr double kMaxRadius = 14.4;          // keeps rotated, rounded points inside the patch
constexpr unsigned kPatternSeed = 20110611;  // any; descriptors of one seed compare only with it

struct Offset {
  std::int8_t x;
  std::int8_t y;
};

struct Test {
  Offset first;
  Offset second;
};

using Pattern = std::array<Test, kTests>;

/// Normal deviate from raw engine output: std::normal_distribution differs between libraries.
double normal_deviate(std::mt19937& engine) {
  const auto uniform = [&engine] { return (static_cast<double>(engine()) + 0.5) / 4294967296.0; };
  const double radius = std::sqrt(-2.0 * std::log(uniform()));
  return radius * std::cos(2.0 * std::numbers::pi * uniform());
}

struct Pair {
  double x1, y1, x2, y2;
};

std::array<Pair, kTests> make_pairs() {
  std::mt19937 engine(kPatternSeed);
  std::array<Pair, kTests> pairs{};
  for (Pair& pair : pairs) {
    do {
      pair.x1 = kPatternSigma * normal_deviate(engine);
      pair.y1 = kPatternSigma * normal_deviate(engine);
      pair.x2 = kPatternSigma * normal_deviate(engine);
      pair.y2 = kPatternSigma * normal_deviate(engine);
    } while (std::hypot(pair.x1, pair.y1) > kMaxRadius ||
             std::hypot(pair.x2, pair.y2) > kMaxRadius ||
             std::hypot(pair.x1 - pair.x2, pair.y1 - pair.y2) < kMinSeparation);
  }
  return pairs;
}

Offset rotated(double x, double y, double angle) {
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  return {static_cast<std::int8_t>(std::lround(c * x - s * y)),
          static_cast<std::int8_t>(std::lround(s * x + c * y))};
}

std::array<Pattern, kDirections> make_patterns() {
  const std::array<Pair, kTests> pairs = make_pairs();
  std::array<Pattern, kDirections> patterns{};
  for (int direction = 0; direction < kDirections; ++direction) {
    const double angle = 2.0 * std::numbers::pi * direction / kDirections;
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      patterns[static_cast<std::size_t>(direction)][i] = {rotated(pairs[i].x1, pairs[i].y1, angle),
                                                          rotated(pairs[i].x2, pairs[i].y2, angle)};
    }
  }
  return patterns;
}

const std::array<Pattern, kDirections>& all_patterns() {
  static const std::array<Pattern, kDirections> kPatterns = make_patterns();
  return kPatterns;
}

const Pattern& pattern_for(float angle) {
  const auto step = std::lround(angle * (kDirections / (2.0 * std::numbers::pi)));
  return all_patterns()[static_cast<std::size_t>(step + kDirections) % kDirections];
}

/// Half width of the circular patch at each row.
std::array<int, kPatchRadius + 1> make_half_widths() {
  std::array<int, kPatchRadius + 1> widths{};
  for (int row = 0; row <= kPatchRadius; ++row) {
    widths[static_cast<std::size_t>(row)] =
        static_cast<int>(std::sqrt(kPatchRadius * kPatchRadius - row * row));
  }
  return widths;
}

}  // namespace

float intensity_direction(const cv::Mat& image, int x, int y) {
  static const auto kHalfWidths = make_half_widths();
  int moment_x = 0;
  int moment_y = 0;
  for (int dy = -kPatchRadius; dy <= kPatchRadius; ++dy) {
    const int half_width = kHalfWidths[static_cast<std::size_t>(std::abs(dy))];
    const std::uint8_t* row = image.ptr<std::uint8_t>(y + dy) + x;
    int sum = 0;
    for (int dx = -half_width; dx <= half_width; ++dx) {
      sum += row[dx];
      moment_x += dx * row[dx];
    }
    moment_y += dy * sum;
  }
  return std::atan2(static_cast<float>(moment_y), static_cast<float>(moment_x));
}

Descriptor oriented_brief(const cv::Mat& blurred, int x, int y, float angle) {
  const Pattern& pattern = pattern_for(angle);
  const auto stride = static_cast<std::ptrdiff_t>(blurred.step[0]);
  const std::uint8_t* centre = blurred.ptr<std::uint8_t>(y) + x;
  const auto grey = [&](const Offset& offset) { return centre[offset.y * stride + offset.x]; };
  Descriptor descriptor{};
  for (std::size_t word = 0; word < descriptor.size(); ++word) {
    std::uint64_t bits = 0;
    for (std::size_t bit = 0; bit < 64; ++bit) {
      const Test& test = pattern[word * 64 + bit];
      bits |= static_cast<std::uint64_t>(grey(test.first) < grey(test.second)) << bit;
    }
    descriptor[word] = bits;
  }
  return descriptor;
}

std::uint32_t descriptor_pattern_id() {
  std::uint32_t hash = 2166136261U;  // FNV-1a
  const auto add = [&hash](std::int8_t value) {
    hash = (hash ^ static_cast<std::uint8_t>(value)) * 16777619U;
  };
  for (const Pattern& pattern : all_patterns()) {
    for (const Test& test : pattern) {
      for (const Offset& offset : {test.first, test.second}) {
        add(offset.x);
        add(offset.y);
      }
    }
  }
  return hash;
}

}  // namespace tsg
