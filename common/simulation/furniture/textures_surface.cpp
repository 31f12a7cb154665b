#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "common/simulation/furniture/textures.hpp"

namespace tsg::simulation::textures {
namespace {

constexpr int kSide = 1024;
constexpr int kSmallSide = 512;

cv::Size square(int side) { return {side, side}; }

/// Small dots of a few pixels in slightly other tones.
void sprinkle(cv::Mat& picture, int count, double contrast, Random& random) {
  const Colour mean = cv::mean(picture);
  for (int i = 0; i < count; ++i) {
    const cv::Point at(random.integer(0, picture.cols - 1), random.integer(0, picture.rows - 1));
    const Colour colour = paint::scaled(mean, 1.0 + contrast * random.uniform(-1.0, 1.0));
    cv::circle(picture, at, random.integer(0, 2), colour, cv::FILLED, cv::LINE_AA);
  }
}

/// Scratches, patches and marks of shoes and chairs along a wall.
void scuff(cv::Mat& picture, int count, Random& random) {
  const Colour mean = cv::mean(picture);
  for (int i = 0; i < count; ++i) {
    const cv::Point at(random.integer(0, picture.cols - 1), random.integer(0, picture.rows - 1));
    const cv::Point reach(random.integer(-22, 22), random.integer(-8, 8));
    paint::line(picture, at, at + reach, paint::scaled(mean, random.uniform(0.72, 0.95)));
    if (i % 4 != 0) continue;
    const cv::Rect patch(at, cv::Size(random.integer(4, 26), random.integer(4, 18)));
    paint::fill(picture, patch, paint::scaled(mean, random.uniform(0.965, 1.03)));
  }
}

void add_flower(cv::Mat& picture,
                const cv::Point& centre,
                const Colour& petals,
                const Colour& middle) {
  for (int petal = 0; petal < 6; ++petal) {
    const double angle = petal * CV_PI / 3.0;
    const cv::Point at =
        centre + cv::Point(cvRound(13 * std::cos(angle)), cvRound(13 * std::sin(angle)));
    cv::ellipse(picture, at, {10, 4}, petal * 60.0, 0, 360, petals, cv::FILLED, cv::LINE_AA);
  }
  cv::circle(picture, centre, 4, middle, cv::FILLED, cv::LINE_AA);
}

}  // namespace

cv::Mat carpet(const Colour& colour, Random& random) {
  const cv::Size size = square(kSide);
  const cv::Mat pile = paint::noise(size, size, random);
  const cv::Mat loops = paint::noise(size, square(kSide / 4), random);
  const cv::Mat wear = paint::fractal(size, square(4), 4, random);
  cv::Mat picture = paint::flat(size, colour);
  paint::shade(picture, 0.22 * pile + 0.22 * loops + 0.16 * wear);
  sprinkle(picture, 900, 0.5, random);
  return picture;
}

cv::Mat carpet_tiles(const Colour& colour, Random& random) {
  constexpr int kTile = kSide / 4;
  cv::Mat picture(square(kSide), CV_8UC3);
  const Colour accent = paint::scaled(colour, random.uniform(1.35, 1.7));
  const cv::Mat ribs = paint::fractal(square(kSide), {kSide / 2, 16}, 3, random);
  cv::Mat source = paint::tinted(1.3 * ribs, paint::scaled(colour, 0.55), accent);
  cv::Mat turned;
  cv::rotate(source, turned, cv::ROTATE_90_CLOCKWISE);
  for (int i = 0; i < 16; ++i) {
    const cv::Rect area(i % 4 * kTile, i / 4 * kTile, kTile, kTile);
    const bool is_turned = (i % 4 + i / 4) % 2 == 0;
    cv::Mat tile = paint::cut(is_turned ? turned : source, area.size(), random);
    tile *= is_turned ? random.uniform(0.84, 0.92) : random.uniform(0.97, 1.05);
    cv::rectangle(tile, {0, 0, kTile, kTile}, paint::scaled(colour, 0.5), 1);
    tile.copyTo(picture(area));
  }
  sprinkle(picture, 500, 0.6, random);
  return picture;
}

cv::Mat linoleum(const Colour& colour, Random& random) {
  const cv::Size size = square(kSide);
  const cv::Mat swirls = paint::fractal(size, {32, 32}, 5, random);
  const cv::Mat wear = paint::fractal(size, square(2), 3, random);
  cv::Mat picture = paint::flat(size, colour);
  paint::shade(picture, 0.2 * swirls + 0.1 * wear);
  sprinkle(picture, 2500, 0.35, random);
  scuff(picture, 40, random);
  return picture;
}

cv::Mat ceramic_tiles(const Colour& colour, Random& random) {
  constexpr int kTile = kSide / 8;
  const cv::Size size = square(kSide);
  cv::Mat picture = paint::flat(size, colour);
  for (int i = 0; i < 64; ++i) {
    const cv::Rect area(i % 8 * kTile, i / 8 * kTile, kTile, kTile);
    paint::fill(picture, area, paint::scaled(colour, random.uniform(0.9, 1.06)));
  }
  paint::shade(picture, 0.1 * paint::fractal(size, square(16), 4, random));
  const Colour grout = paint::between(colour, {120, 122, 125}, 0.65);
  for (int i = 0; i < 8; ++i) {
    paint::fill(picture, {i * kTile, 0, 3, kSide}, grout);
    paint::fill(picture, {0, i * kTile, kSide, 3}, grout);
  }
  return picture;
}

cv::Mat plaster(const Colour& colour, Random& random) {
  const cv::Size size = square(kSide);
  const cv::Mat trowel = paint::fractal(size, square(8), 4, random);
  const cv::Mat bumps = paint::fractal(size, square(kSide / 8), 3, random);
  cv::Mat picture = paint::flat(size, colour);
  paint::shade(picture, 0.03 * trowel + 0.035 * bumps);
  scuff(picture, 130, random);
  return picture;
}

cv::Mat wallpaper(const Colour& colour, Random& random) {
  const cv::Size size = square(kSmallSide);
  constexpr int kPitch = kSmallSide / 4;
  cv::Mat picture = paint::flat(size, colour);
  const Colour stripe = paint::scaled(colour, 0.92);
  for (int column = 0; column < 4; ++column) {
    paint::fill(picture, {column * kPitch, 0, kPitch / 2, kSmallSide}, stripe);
  }
  for (int i = 0; i < 16; ++i) {
    const int column = i % 4;
    const cv::Point centre(column * kPitch + kPitch / 4,
                           i / 4 * kPitch + (column % 2 + 1) * kPitch / 4);
    add_flower(picture, centre, paint::scaled(colour, 0.76), stripe);
  }
  paint::shade(picture, 0.05 * paint::fractal(size, square(64), 3, random));
  return picture;
}

cv::Mat brick(const Colour& colour, Random& random) {
  constexpr int kRows = 32;
  constexpr int kHeight = kSide / kRows;
  constexpr int kColumns = 8;
  constexpr int kWidth = kSide / kColumns;
  const cv::Size size = square(kSide);
  const Colour mortar = paint::between(colour, {170, 175, 180}, 0.75);
  cv::Mat picture = paint::flat(size, mortar);
  for (int row = 0; row < kRows; ++row) {
    for (int column = 0; column < kColumns; ++column) {
      const Colour tone = paint::scaled(colour, random.uniform(0.68, 1.15));
      const int x = column * kWidth + row % 2 * kWidth / 2 + 3;
      const cv::Rect stone(x, row * kHeight + 3, kWidth - 6, kHeight - 6);
      paint::fill(picture, stone, tone);
      paint::fill(picture, stone - cv::Point(kSide, 0), tone);
    }
  }
  paint::shade(picture, 0.22 * paint::fractal(size, square(64), 4, random));
  return picture;
}

cv::Mat concrete(const Colour& colour, Random& random) {
  const cv::Size size = square(kSide);
  const cv::Mat clouds = paint::fractal(size, square(4), 7, random);
  cv::Mat picture = paint::flat(size, colour);
  paint::shade(picture, 0.35 * clouds + 0.08 * paint::noise(size, square(kSide / 2), random));
  for (int i = 0; i < 500; ++i) {  // air bubbles of the mould
    const cv::Point at(random.integer(0, kSide - 1), random.integer(0, kSide - 1));
    cv::circle(picture, at, random.integer(0, 3), paint::scaled(colour, random.uniform(0.5, 0.8)),
               cv::FILLED, cv::LINE_AA);
  }
  for (int i = 0; i < 2; ++i) {  // joints between panels
    paint::fill(picture, {i * kSide / 2, 0, 3, kSide}, paint::scaled(colour, 0.55));
    paint::fill(picture, {0, i * kSide / 2, kSide, 3}, paint::scaled(colour, 0.55));
  }
  return picture;
}

cv::Mat ceiling_tiles(Random& random) {
  constexpr int kTile = kSide / 4;
  const cv::Size size = square(kSide);
  const Colour white(232, 236, 237);
  cv::Mat picture = paint::flat(size, white);
  for (int i = 0; i < 6000; ++i) {  // the holes of acoustic tiles
    const cv::Point at(random.integer(0, kSide - 1), random.integer(0, kSide - 1));
    const cv::Point reach(random.integer(-5, 5), random.integer(-2, 2));
    paint::line(picture, at, at + reach, paint::scaled(white, random.uniform(0.6, 0.9)));
  }
  for (int i = 0; i < 16; ++i) {
    const cv::Rect area(i % 4 * kTile, i / 4 * kTile, kTile, kTile);
    cv::Mat tile = picture(area);
    tile *= random.uniform(0.94, 1.0);
    cv::rectangle(tile, {0, 0, kTile, kTile}, {205, 207, 208}, 5);
    cv::rectangle(tile, {4, 4, kTile - 8, kTile - 8}, {168, 170, 172}, 1);
  }
  return picture;
}

}  // namespace tsg::simulation::textures
