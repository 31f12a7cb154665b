#include "services/slam/lib/oriented_brief.hpp"

#include <algorithm>
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

constexpr int kPatchSide = 2 * kPatchRadius + 1;
constexpr int kPatchStride = 32;  // bytes from row to row of a patch that was copied out

/// The grey values around a corner, rows one after another: pixels to compare are found by one
/// number, whatever the width of the image.
using Patch = std::array<std::uint8_t, static_cast<std::size_t>(kPatchStride* kPatchSide)>;

/// Where in a Patch.
using Offset = std::uint16_t;

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
  const auto column = kPatchRadius + std::lround(c * x - s * y);
  const auto row = kPatchRadius + std::lround(s * x + c * y);
  return static_cast<Offset>(row * kPatchStride + column);
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

constexpr std::size_t kHalf = kPatchRadius + 1;  // columns of a half: the middle is in both

/// For each distance from the middle row: 255 at the columns, from the middle one outwards, that
/// lie in the circular patch.
using HalfDisc = std::array<std::array<std::uint8_t, kHalf>, kHalf>;

HalfDisc make_disc() {
  HalfDisc disc{};
  for (std::size_t row = 0; row < kHalf; ++row) {
    for (std::size_t column = 0; column < kHalf; ++column) {
      const bool inside = row * row + column * column <= std::size_t{kPatchRadius * kPatchRadius};
      disc[row][column] = inside ? 255 : 0;
    }
  }
  return disc;
}

/// The same, from the left to the middle column, which the other half has already.
HalfDisc make_left_disc() {
  HalfDisc disc = make_disc();
  for (auto& row : disc) {
    std::reverse(row.begin(), row.end());
    row.back() = 0;
  }
  return disc;
}

/// Sums over the columns of one half of a patch. 16 bits do, also half way down: 31 rows of 255;
/// 255 times the sum of 1 to 15. All columns are added up at once then.
struct ColumnSums {
  std::array<std::int16_t, kHalf> grey{};
  std::array<std::int16_t, kHalf> moment{};  ///< grey times the distance from the middle row

  void add_row(const std::uint8_t* row, const std::array<std::uint8_t, kHalf>& disc, int distance) {
    for (std::size_t i = 0; i < kHalf; ++i) {
      const int value = row[i] & disc[i];
      grey[i] = static_cast<std::int16_t>(grey[i] + value);
      moment[i] = static_cast<std::int16_t>(moment[i] + distance * value);
    }
  }
};

}  // namespace

float intensity_direction(const cv::Mat& image, int x, int y) {
  static const HalfDisc kRightDisc = make_disc();
  static const HalfDisc kLeftDisc = make_left_disc();
  ColumnSums left;
  ColumnSums right;
  for (int dy = -kPatchRadius; dy <= kPatchRadius; ++dy) {
    const std::uint8_t* middle = image.ptr<std::uint8_t>(y + dy) + x;
    const auto row = static_cast<std::size_t>(std::abs(dy));
    left.add_row(middle - kPatchRadius, kLeftDisc[row], dy);
    right.add_row(middle, kRightDisc[row], dy);
  }
  int moment_x = 0;
  int moment_y = 0;
  for (int i = 0; i <= kPatchRadius; ++i) {
    const auto column = static_cast<std::size_t>(i);
    moment_x += (i - kPatchRadius) * left.grey[column] + i * right.grey[column];
    moment_y += left.moment[column] + right.moment[column];
  }
  return std::atan2(static_cast<float>(moment_y), static_cast<float>(moment_x));
}

Descriptor oriented_brief(const cv::Mat& blurred, int x, int y, float angle) {
  const Pattern& pattern = pattern_for(angle);
  Patch patch;  // all that is read of it is written
  for (int row = 0; row < kPatchSide; ++row) {
    const std::uint8_t* from = blurred.ptr<std::uint8_t>(y - kPatchRadius + row) + x - kPatchRadius;
    std::copy_n(from, kPatchSide, patch.begin() + row * kPatchStride);
  }
  Descriptor descriptor{};
  for (std::size_t word = 0; word < descriptor.size(); ++word) {
    std::uint64_t bits = 0;
    for (std::size_t bit = 0; bit < 64; ++bit) {
      const Test& test = pattern[word * 64 + bit];
      bits |= static_cast<std::uint64_t>(patch[test.first] < patch[test.second]) << bit;
    }
    descriptor[word] = bits;
  }
  return descriptor;
}

std::uint32_t descriptor_pattern_id() {
  std::uint32_t hash = 2166136261U;  // FNV-1a
  const auto add = [&hash](int value) {
    hash = (hash ^ static_cast<std::uint8_t>(value)) * 16777619U;
  };
  for (const Pattern& pattern : all_patterns()) {
    for (const Test& test : pattern) {
      for (const int offset : {test.first, test.second}) {
        add(offset % kPatchStride - kPatchRadius);
        add(offset / kPatchStride - kPatchRadius);
      }
    }
  }
  return hash;
}

}  // namespace tsg
