#include <algorithm>
#include <array>
#include <cmath>

#include "common/simulation/people/body_textures.hpp"
#include "common/simulation/people/easing.hpp"
#include "common/simulation/people/noise.hpp"
#include "common/simulation/random.hpp"

namespace tsg::simulation {
namespace {

using Dye = cv::Vec3d;

constexpr int kPixels = 512;

Dye as_colour(const cv::Vec3b& bytes) {
  return {static_cast<double>(bytes[0]), static_cast<double>(bytes[1]),
          static_cast<double>(bytes[2])};
}

/// Position within a period, 0..1.
double fraction(double value) { return value - std::floor(value); }

bool in_band(double value, double from, double to) {
  const double f = fraction(value);
  return f >= from && f < to;
}

struct Dyes {
  Dye ground;
  Dye accent;
  Dye second;
};

Dye striped(const Dyes& dyes, double y_m) {
  if (in_band(y_m / 0.075, 0.0, 0.42)) return dyes.accent;
  if (in_band(y_m / 0.075, 0.62, 0.70)) return dyes.second;
  return dyes.ground;
}

/// Tartan: threads of both directions shine through each other.
Dye checked(const Dyes& dyes, double x_m, double y_m) {
  const auto thread = [&dyes](double along) {
    if (in_band(along / 0.072, 0.0, 0.38)) return dyes.accent;
    if (in_band(along / 0.072, 0.62, 0.70)) return dyes.second;
    return dyes.ground;
  };
  return 0.5 * thread(x_m) + 0.5 * thread(y_m + 0.01);
}

Dye with_diamonds(const Dyes& dyes, double x_m, double y_m) {
  const double u = fraction(x_m / 0.10) - 0.5;
  const double v = fraction(y_m / 0.14) - 0.5;
  const bool is_line = in_band((x_m / 0.10 + y_m / 0.14), 0.48, 0.52) ||
                       in_band((x_m / 0.10 - y_m / 0.14), 0.48, 0.52);
  if (is_line) return dyes.second;
  return std::abs(u) + std::abs(v) < 0.5 ? dyes.accent : dyes.ground;
}

Dye dotted(const Dyes& dyes, double x_m, double y_m) {
  const double row = std::floor(y_m / 0.032);
  const double u = fraction(x_m / 0.037 + 0.5 * std::fmod(std::abs(row), 2.0)) - 0.5;
  const double v = fraction(y_m / 0.032) - 0.5;
  const double radius = std::hypot(u, v);
  if (radius < 0.16) return dyes.second;
  return radius < 0.30 ? dyes.accent : dyes.ground;
}

/// Leaves and blossoms: each cell of a grid has one, turned and sized by chance.
Dye printed(const Dyes& dyes, std::uint64_t seed, double x_m, double y_m) {
  constexpr double kCellM = 0.055;
  const auto column = static_cast<std::int64_t>(std::floor(x_m / kCellM));
  const auto row = static_cast<std::int64_t>(std::floor(y_m / kCellM));
  for (std::int64_t i = 0; i < 9; ++i) {
    const std::int64_t cx = column + i % 3 - 1;
    const std::int64_t cy = row + i / 3 - 1;
    Random random(mixed(seed ^ mixed(static_cast<std::uint64_t>(cx * 7919 + cy))));
    const double dx = x_m - kCellM * (static_cast<double>(cx) + random.uniform(0.2, 0.8));
    const double dy = y_m - kCellM * (static_cast<double>(cy) + random.uniform(0.2, 0.8));
    const double turn = random.uniform(0.0, kPi);
    const double size = random.uniform(0.015, 0.028);
    const bool is_blossom = random.chance(0.5);
    const double radius = std::hypot(dx, dy);
    if (is_blossom) {
      const double petals = size * (0.65 + 0.35 * std::cos(5.0 * std::atan2(dy, dx) + turn));
      if (radius < 0.3 * size) return dyes.second;
      if (radius < petals) return dyes.accent;
      continue;
    }
    const double along = dx * std::cos(turn) + dy * std::sin(turn);
    const double across = dy * std::cos(turn) - dx * std::sin(turn);
    const double leaf = 1.0 - along * along / (1.6 * size * size);
    if (leaf > 0.0 && std::abs(across) < 0.4 * size * leaf) {
      return std::abs(across) < 0.0015 ? dyes.accent : dyes.second;
    }
  }
  return dyes.ground;
}

Dye blocks(const Dyes& dyes, double x_m, double y_m) {
  if (y_m < 0.20) return dyes.ground;
  if (y_m < 0.235) return dyes.second;
  if (y_m < 0.25 + 0.02 * std::abs(2.0 * fraction(x_m / 0.06) - 1.0)) return dyes.accent;
  return y_m < 0.40 ? dyes.accent : dyes.ground * 0.7;
}

/// Rows of V-shaped stitches, with a band of ornament.
Dye knitted(const Dyes& dyes, double x_m, double y_m) {
  const double slant = 0.5 * std::abs(2.0 * fraction(x_m / 0.012) - 1.0);
  const double stitch = fraction(y_m / 0.009 + slant);
  const double shade = 0.72 + 0.28 * std::sin(kPi * stitch);
  const double zigzag = 0.018 * std::abs(2.0 * fraction(x_m / 0.05) - 1.0);
  const double band = fraction(y_m / 0.13);
  const bool is_ornament = std::abs(0.13 * band - 0.05 - zigzag) < 0.008;
  const bool is_second = std::abs(0.13 * band - 0.09 + zigzag) < 0.004;
  return shade * (is_ornament ? dyes.accent : is_second ? dyes.second : dyes.ground);
}

/// Twill with white threads, faded by chance.
Dye denim(const Dyes& dyes, std::uint64_t seed, double x_m, double y_m) {
  const double twill = fraction((x_m + y_m) / 0.0045);
  const double fade = noise(seed + 1, x_m / 0.12, y_m / 0.30);
  const double grain = noise(seed + 2, x_m / 0.004, y_m / 0.012);
  const double white = 0.10 + 0.18 * fade + 0.12 * grain + (twill < 0.3 ? 0.08 : 0.0);
  return dyes.ground + (Dye(215, 215, 205) - dyes.ground) * std::clamp(white, 0.0, 0.6);
}

Dye dyed(const Cloth& cloth, double x_m, double y_m) {
  const Dyes dyes{as_colour(cloth.ground), as_colour(cloth.accent), as_colour(cloth.second)};
  switch (cloth.pattern) {
    case Pattern::kPlain:
      return dyes.ground;
    case Pattern::kStripes:
      return striped(dyes, y_m);
    case Pattern::kChecks:
      return checked(dyes, x_m, y_m);
    case Pattern::kDiamonds:
      return with_diamonds(dyes, x_m, y_m);
    case Pattern::kDots:
      return dotted(dyes, x_m, y_m);
    case Pattern::kPrint:
      return printed(dyes, cloth.seed, x_m, y_m);
    case Pattern::kBlocks:
      return blocks(dyes, x_m, y_m);
    case Pattern::kKnit:
      return knitted(dyes, x_m, y_m);
    case Pattern::kDenim:
      return denim(dyes, cloth.seed, x_m, y_m);
  }
  return dyes.ground;
}

/// Light and dark of folds and creases: slanting ridges of chance.
double folds(std::uint64_t seed, double x_m, double y_m) {
  const double wide = noise(seed + 5, (x_m + 0.35 * y_m) / 0.07, (y_m - 0.3 * x_m) / 0.16);
  const double narrow = noise(seed + 6, (x_m - 0.5 * y_m) / 0.028, y_m / 0.075);
  const double ridge = 1.0 - std::abs(2.0 * wide - 1.0);
  return 0.80 + 0.22 * ridge + 0.12 * (narrow - 0.5);
}

}  // namespace

cv::Mat paint_cloth(const Cloth& cloth, const cv::Size2d& size_m) {
  cv::Mat image(kPixels, kPixels, CV_8UC3);
  for (int row = 0; row < image.rows; ++row) {
    const double y_m = size_m.height * (row + 0.5) / image.rows;
    for (int column = 0; column < image.cols; ++column) {
      const double x_m = size_m.width * (column + 0.5) / image.cols;
      const double weave = 0.93 + 0.14 * noise(cloth.seed + 7, x_m / 0.0022, y_m / 0.0022);
      const Dye colour = dyed(cloth, x_m, y_m) * (weave * folds(cloth.seed, x_m, y_m));
      image.at<cv::Vec3b>(row, column) = cv::Vec3b(cv::saturate_cast<unsigned char>(colour[0]),
                                                   cv::saturate_cast<unsigned char>(colour[1]),
                                                   cv::saturate_cast<unsigned char>(colour[2]));
    }
  }
  return image;
}

}  // namespace tsg::simulation
