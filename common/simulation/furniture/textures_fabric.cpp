#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "common/simulation/furniture/textures.hpp"

namespace tsg::simulation::textures {
namespace {

constexpr int kClothSide = 256;
const cv::Size kSize(kClothSide, kClothSide);

void add_stripes(cv::Mat& picture, const Colour& colour, Random& random) {
  const int pitch = 1 << random.integer(4, 6);
  for (int x = 0; x < kClothSide; x += pitch) {
    paint::fill(picture, {x, 0, pitch / 3, kClothSide}, colour);
    paint::fill(picture, {x + pitch / 2, 0, 2, kClothSide}, paint::scaled(colour, 0.7));
  }
}

void add_checks(cv::Mat& picture, const Colour& colour, Random& random) {
  const int pitch = 1 << random.integer(5, 6);
  cv::Mat above = picture.clone();
  for (int x = 0; x < kClothSide; x += pitch) {
    paint::fill(above, {x, 0, pitch / 2, kClothSide}, colour);
    paint::fill(picture, {0, x, kClothSide, pitch / 2}, colour);
  }
  cv::addWeighted(picture, 0.5, above, 0.5, 0.0, picture);
}

void add_dots(cv::Mat& picture, const Colour& colour, Random& random) {
  const int pitch = 1 << random.integer(4, 6);
  for (int y = 0; y < kClothSide; y += pitch) {
    for (int x = 0; x < kClothSide; x += pitch) {
      const cv::Point at(x + (y / pitch % 2 + 1) * pitch / 4, y + pitch / 2);
      cv::circle(picture, at, pitch / 5, colour, cv::FILLED, cv::LINE_AA);
    }
  }
}

/// Rows of diamonds between two lines, as woven into borders.
void weave_border(cv::Mat& picture, int inset, int width, const Colour& colour) {
  const int side = picture.cols;
  cv::rectangle(picture, {inset, inset, side - 2 * inset, side - 2 * inset}, colour, 2);
  const int middle = inset + width / 2;
  for (int at = middle; at < side - inset; at += width) {
    for (const cv::Point& centre : {cv::Point(at, middle), cv::Point(at, side - middle),
                                    cv::Point(middle, at), cv::Point(side - middle, at)}) {
      const int reach = width / 2 - 2;
      const std::vector<cv::Point> diamond = {
          centre + cv::Point(reach, 0), centre + cv::Point(0, reach), centre - cv::Point(reach, 0),
          centre - cv::Point(0, reach)};
      cv::fillConvexPoly(picture, diamond, colour, cv::LINE_AA);
    }
  }
}

/// Medallions one in another around the middle, the same to all four sides.
void weave_medallion(cv::Mat& picture, const Colour& first, const Colour& second) {
  const cv::Point centre(picture.cols / 2, picture.rows / 2);
  for (int ring = 6; ring > 0; --ring) {
    const Colour& colour = ring % 2 == 0 ? first : second;
    for (int petal = 0; petal < 4 * ring; ++petal) {
      const double angle = 2.0 * CV_PI * petal / (4.0 * ring);
      const cv::Point at = centre + cv::Point(cvRound(22.0 * ring * std::cos(angle)),
                                              cvRound(22.0 * ring * std::sin(angle)));
      cv::ellipse(picture, at, {12, 6}, angle * 180.0 / CV_PI, 0, 360, colour, cv::FILLED,
                  cv::LINE_AA);
    }
  }
}

}  // namespace

cv::Mat weave(const Colour& colour, Random& random) {
  cv::Mat threads(kSize, CV_32FC1);
  const cv::Mat fuzz = paint::noise(kSize, kSize, random);
  const cv::Mat wear = paint::fractal(kSize, {4, 4}, 3, random);
  for (int y = 0; y < kClothSide; ++y) {
    for (int x = 0; x < kClothSide; ++x) {
      const bool is_over = (x / 4 + y / 4) % 2 == 0;
      const float across =
          std::sin(static_cast<float>(is_over ? x : y) * std::numbers::pi_v<float> / 4.0F);
      threads.at<float>(y, x) = 0.18F * std::abs(across) + (is_over ? 0.06F : -0.06F);
    }
  }
  cv::Mat picture = paint::flat(kSize, colour);
  paint::shade(picture, threads + 0.16 * fuzz + 0.14 * wear);
  return picture;
}

cv::Mat patterned(const Colour& colour, Random& random) {
  cv::Mat picture = paint::flat(kSize, colour);
  const Colour other = paint::between(paint::any_colour(random), {225, 230, 235}, 0.5);
  const int kind = random.integer(0, 2);
  if (kind == 0) add_stripes(picture, other, random);
  if (kind == 1) add_checks(picture, other, random);
  if (kind == 2) add_dots(picture, other, random);
  paint::shade(picture, 0.18 * paint::noise(kSize, kSize, random));
  return picture;
}

cv::Mat leather(const Colour& colour, Random& random) {
  cv::Mat creases = cv::abs(paint::fractal(kSize, {32, 32}, 3, random));
  cv::Mat picture = paint::flat(kSize, colour);
  paint::shade(picture, 0.35 * creases + 0.2 * paint::fractal(kSize, {4, 4}, 3, random));
  return picture;
}

cv::Mat rug(Random& random) {
  constexpr int kRugSide = 512;
  const cv::Size size(kRugSide, kRugSide);
  const double hue = random.uniform(0.0, 360.0);
  const Colour ground = paint::hsv(hue, 0.65, 0.5);
  const Colour light = paint::hsv(std::fmod(hue + random.uniform(20.0, 60.0), 360.0), 0.3, 0.85);
  const Colour dark = paint::hsv(std::fmod(hue + 180.0, 360.0), 0.5, 0.25);
  cv::Mat picture = paint::flat(size, ground);
  paint::fill(picture, {60, 60, kRugSide - 120, kRugSide - 120}, paint::scaled(ground, 0.75));
  weave_border(picture, 6, 22, light);
  weave_border(picture, 32, 26, dark);
  weave_border(picture, 64, 14, light);
  weave_medallion(picture, light, dark);
  for (int i = 0; i < 140; ++i) {  // small flowers all over the field
    const cv::Point at(random.integer(90, kRugSide - 90), random.integer(90, kRugSide - 90));
    cv::drawMarker(picture, at, i % 2 == 0 ? light : dark, cv::MARKER_TILTED_CROSS, 7, 2);
  }
  paint::shade(picture, 0.2 * paint::noise(size, size, random) +
                            0.15 * paint::fractal(size, {8, 8}, 3, random));
  return picture;
}

cv::Mat brushed_metal(const Colour& colour, Random& random) {
  cv::Mat picture = paint::flat(kSize, colour);
  paint::shade(picture, 0.12 * paint::fractal(kSize, {4, kClothSide}, 1, random) +
                            0.08 * paint::fractal(kSize, {4, 4}, 3, random));
  return picture;
}

cv::Mat cardboard(Random& random) {
  const Colour brown(96, 140, 178);
  const Colour ink(60, 70, 80);
  cv::Mat picture = paint::flat(kSize, brown);
  paint::fill(picture, {0, 112, kClothSide, 26}, {118, 170, 205});  // tape
  paint::write(picture, paint::phrase(random, 1), {18, 60}, 16, ink);
  paint::print_lines(picture, {20, 72, 110, 30}, 8, ink, random);
  cv::rectangle(picture, {168, 26, 60, 66}, ink, 3);
  cv::arrowedLine(picture, {184, 84}, {184, 36}, ink, 4, cv::LINE_AA, 0, 0.35);
  cv::arrowedLine(picture, {212, 84}, {212, 36}, ink, 4, cv::LINE_AA, 0, 0.35);
  paint::fill(picture, {24, 160, 104, 70}, {232, 236, 238});  // address label
  paint::print_lines(picture, {32, 168, 84, 34}, 7, {40, 40, 40}, random);
  for (int x = 34; x < 118; x += random.integer(3, 7)) {
    paint::fill(picture, {x, 208, random.integer(1, 3), 16}, {30, 30, 30});
  }
  paint::shade(picture, 0.1 * paint::fractal(kSize, {8, 64}, 3, random));
  return picture;
}

cv::Mat bark(Random& random) {
  const cv::Mat weight = paint::fractal(kSize, {32, 8}, 4, random);
  return paint::tinted(1.6 * weight, {22, 34, 48}, {96, 122, 146});
}

cv::Mat leaf(const Colour& colour, Random& random) {
  constexpr int kLeafSide = 64;
  const cv::Size size(kLeafSide, kLeafSide);
  cv::Mat picture = paint::flat(size, colour);
  const Colour vein = paint::between(colour, {150, 220, 200}, 0.45);
  for (int y = 4; y < kLeafSide + 20; y += 9) {
    paint::line(picture, {32, y}, {0, y - 18}, vein);
    paint::line(picture, {32, y}, {63, y - 18}, vein);
  }
  cv::line(picture, {32, 0}, {32, 63}, vein, 2);
  paint::shade(picture, 0.25 * paint::fractal(size, {8, 8}, 3, random));
  return picture;
}

cv::Mat soil(Random& random) {
  return paint::tinted(paint::fractal(kSize, {32, 32}, 4, random) * 1.5, {14, 22, 32},
                       {52, 68, 88});
}

}  // namespace tsg::simulation::textures
