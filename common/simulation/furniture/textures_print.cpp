#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "common/simulation/furniture/textures.hpp"

namespace tsg::simulation::textures {
namespace {

const cv::Size kPosterSize(512, 512);

/// From `top` to `bottom`, row by row.
cv::Mat gradient(const cv::Size& size, const Colour& top, const Colour& bottom) {
  cv::Mat picture(size, CV_8UC3);
  for (int y = 0; y < size.height; ++y) {
    paint::fill(picture, {0, y, size.width, 1},
                paint::between(top, bottom, static_cast<double>(y) / size.height));
  }
  return picture;
}

/// Everything below a jagged ridge, as a range of hills or a wood.
void add_ridge(cv::Mat& picture, int horizon, int relief, const Colour& colour, Random& random) {
  const int columns = picture.cols;
  const cv::Mat profile = paint::fractal({columns, 1}, {4, 1}, 7, random);
  for (int x = 0; x < columns; ++x) {
    const int y = horizon - cvRound(relief * double{profile.at<float>(0, x)});
    paint::line(picture, {x, std::max(y, 0)}, {x, picture.rows - 1}, colour);
  }
}

void add_tree(cv::Mat& picture, const cv::Point& foot, int height, Random& random) {
  const Colour trunk(30, 45, 60);
  const Colour green = paint::hsv(random.uniform(70.0, 130.0), 0.6, random.uniform(0.25, 0.5));
  cv::line(picture, foot, foot - cv::Point(0, height), trunk, std::max(1, height / 14));
  for (int i = 0; i < 90; ++i) {
    const cv::Point at = foot + cv::Point(random.integer(-height / 3, height / 3),
                                          -height + random.integer(-height / 3, height / 3));
    cv::circle(picture, at, height / random.integer(10, 18),
               paint::scaled(green, (i < 45 ? 0.75 : 1.15) * random.uniform(0.75, 1.25)),
               cv::FILLED, cv::LINE_AA);
  }
}

void add_house(cv::Mat& picture, const cv::Rect& body, Random& random) {
  const Colour wall = paint::hsv(random.uniform(10.0, 50.0), 0.25, random.uniform(0.55, 0.9));
  const Colour roof = paint::hsv(random.uniform(0.0, 25.0), 0.6, 0.45);
  paint::fill(picture, body, wall);
  const std::vector<cv::Point> gable = {{body.x - 6, body.y},
                                        {body.x + body.width / 2, body.y - body.width / 3},
                                        {body.br().x + 6, body.y}};
  cv::fillConvexPoly(picture, gable, roof, cv::LINE_AA);
  for (int y = body.y + 8; y + 14 < body.br().y; y += 22) {
    for (int x = body.x + 7; x + 10 < body.br().x; x += 18) {
      paint::fill(picture, {x, y, 10, 14}, paint::scaled({110, 90, 70}, random.uniform(0.6, 1.3)));
      cv::rectangle(picture, {x, y, 10, 14}, {230, 235, 235}, 1);
    }
  }
}

cv::Mat typographic(Random& random) {
  const Colour ground = paint::any_colour(random);
  const Colour ink = paint::between(ground, {245, 248, 250}, 0.9);
  cv::Mat picture = paint::flat(kPosterSize, ground);
  paint::fill(picture, {0, 330, 512, 12}, ink);
  const int lines = random.integer(2, 4);
  for (int i = 0; i < lines; ++i) {
    paint::write(picture, paint::phrase(random, 1), {28, 90 + 75 * i}, random.integer(36, 62), ink);
  }
  paint::print_lines(picture, {30, 360, 210, 120}, 13, ink, random);
  cv::circle(picture, {390, 420}, 60, ink, 10, cv::LINE_AA);
  cv::circle(picture, {390, 420}, 28, paint::any_colour(random), cv::FILLED, cv::LINE_AA);
  return picture;
}

void add_chart(cv::Mat& picture, const cv::Rect& area, const Colour& colour, Random& random) {
  cv::rectangle(picture, area, {90, 90, 90}, 1);
  const bool is_bars = random.chance(0.5);
  const int steps = 8;
  cv::Point last(area.x, area.br().y - area.height / 3);
  for (int i = 0; i < steps; ++i) {
    const int x = area.x + 8 + i * (area.width - 16) / steps;
    const int height = random.integer(area.height / 8, area.height - 12);
    if (is_bars) {
      paint::fill(picture, {x, area.br().y - height, area.width / 12, height},
                  paint::scaled(colour, random.uniform(0.7, 1.3)));
    } else {
      cv::line(picture, last, {x, area.br().y - height}, colour, 3, cv::LINE_AA);
      last = {x, area.br().y - height};
      cv::circle(picture, last, 5, paint::scaled(colour, 0.6), cv::FILLED, cv::LINE_AA);
    }
  }
}

/// A poster of a conference: title bar, columns of text, charts.
cv::Mat scientific(Random& random) {
  const Colour bar = paint::hsv(random.uniform(180.0, 260.0), 0.7, 0.5);
  cv::Mat picture = paint::flat(kPosterSize, {240, 243, 244});
  paint::fill(picture, {0, 0, 512, 74}, bar);
  paint::write(picture, paint::phrase(random, 3), {16, 36}, 22, {250, 250, 250});
  paint::write(picture, paint::phrase(random, 4), {16, 62}, 12, {220, 220, 220});
  for (int i = 0; i < 9; ++i) {
    const cv::Rect cell(14 + i / 3 * 166, 88 + i % 3 * 140, 152, 128);
    paint::write(picture, paint::phrase(random, 2), {cell.x, cell.y + 12}, 11, bar);
    const cv::Rect body(cell.x, cell.y + 22, cell.width, cell.height - 26);
    if (i % 2 == 0) {
      paint::print_lines(picture, body, 9, {70, 70, 70}, random);
    } else {
      add_chart(picture, body, paint::any_colour(random), random);
    }
  }
  return picture;
}

cv::Mat map(Random& random) {
  const cv::Mat height = paint::fractal(kPosterSize, {4, 4}, 6, random);
  cv::Mat picture(kPosterSize, CV_8UC3);
  for (int y = 0; y < picture.rows; ++y) {
    for (int x = 0; x < picture.cols; ++x) {
      const float level = height.at<float>(y, x);
      const bool is_contour = std::abs(std::remainder(level, 0.07F)) < 0.005F;
      Colour colour = level < -0.02F ? Colour(210, 175, 120) : Colour(150, 205, 190);
      if (level > 0.18F) colour = {140, 185, 220};
      if (is_contour) colour *= 0.72;
      picture.at<cv::Vec3b>(y, x) = {static_cast<uchar>(colour[0]), static_cast<uchar>(colour[1]),
                                     static_cast<uchar>(colour[2])};
    }
  }
  for (int i = 0; i < 24; ++i) {
    const cv::Point from(random.integer(0, 511), random.integer(0, 511));
    const cv::Point to = from + cv::Point(random.integer(-120, 120), random.integer(-120, 120));
    cv::line(picture, from, to, i % 3 == 0 ? Colour(60, 90, 220) : Colour(235, 240, 240),
             i % 3 == 0 ? 3 : 2, cv::LINE_AA);
    cv::circle(picture, from, 4, {40, 40, 40}, cv::FILLED, cv::LINE_AA);
    paint::write(picture, paint::phrase(random, 1), from + cv::Point(6, -4), 9, {40, 40, 40});
  }
  cv::rectangle(picture, {0, 0, 512, 512}, {230, 235, 235}, 14);
  return picture;
}

cv::Mat abstract_art(Random& random) {
  const Colour ground = paint::hsv(random.uniform(20.0, 60.0), 0.15, 0.9);
  cv::Mat picture = paint::flat(kPosterSize, ground);
  const double hue = random.uniform(0.0, 360.0);
  for (int i = 0; i < 26; ++i) {
    const Colour colour = paint::hsv(std::fmod(hue + random.normal() * 50.0 + 720.0, 360.0),
                                     random.uniform(0.4, 0.9), random.uniform(0.2, 0.95));
    const cv::Point at(random.integer(0, 511), random.integer(0, 511));
    const int reach = random.integer(15, 110);
    if (i % 3 == 0) cv::circle(picture, at, reach, colour, cv::FILLED, cv::LINE_AA);
    if (i % 3 == 1) paint::fill(picture, {at.x, at.y, reach, random.integer(20, 160)}, colour);
    if (i % 3 == 2) {
      cv::line(picture, at, at + cv::Point(3 * reach, random.integer(-90, 90)), colour,
               random.integer(2, 14), cv::LINE_AA);
    }
  }
  paint::shade(picture, 0.08 * paint::fractal(kPosterSize, {64, 64}, 3, random));
  return picture;
}

cv::Mat framed_landscape(Random& random) {
  cv::Mat picture = paint::flat(kPosterSize, {236, 240, 242});
  landscape({448, 384}, random).copyTo(picture(cv::Rect(32, 32, 448, 384)));
  paint::write(picture, paint::phrase(random, 2), {36, 470}, 30, {50, 50, 50});
  return picture;
}

}  // namespace

cv::Mat landscape(const cv::Size& size, Random& random) {
  // Made at a size that noise can repeat in, then brought to that asked for.
  const cv::Size made(512, 512);
  const bool is_evening = random.chance(0.4);
  const Colour zenith = is_evening ? Colour(120, 70, 60) : Colour(220, 150, 80);
  const Colour haze = is_evening ? Colour(110, 170, 250) : Colour(240, 232, 220);
  cv::Mat picture = gradient(made, zenith, haze);
  cv::Mat clouds = cv::max(paint::fractal(made, {4, 16}, 5, random), 0.0);
  paint::shade(picture, 0.9 * clouds);
  const double hue = random.uniform(90.0, 230.0);
  for (int layer = 0; layer < 4; ++layer) {
    const double nearness = 0.25 * (layer + 1);
    const Colour hill = paint::between(haze, paint::hsv(hue - 20.0 * layer, 0.5, 0.35), nearness);
    add_ridge(picture, 250 + 55 * layer, 110 - 20 * layer, hill, random);
  }
  for (int i = 0; i < 14; ++i) {
    const int y = random.integer(420, 511);
    add_tree(picture, {random.integer(0, 511), y}, 30 + (y - 420) / 2, random);
  }
  paint::shade(picture, 0.12 * paint::fractal(made, {64, 64}, 3, random));
  cv::Mat result;
  cv::resize(picture, result, size, 0, 0, cv::INTER_AREA);
  return result;
}

cv::Mat poster(Random& random) {
  constexpr std::array kLayouts = {&framed_landscape, &typographic, &scientific, &map,
                                   &abstract_art};
  return kLayouts.at(static_cast<std::size_t>(random.integer(0, kLayouts.size() - 1)))(random);
}

cv::Mat outside(Random& random) {
  const cv::Size size(1024, 512);
  cv::Mat picture = gradient(size, {250, 205, 160}, {250, 245, 240});
  cv::Mat clouds = cv::max(paint::fractal(size, {8, 16}, 5, random), 0.0);
  paint::shade(picture, 0.5 * clouds);
  add_ridge(picture, 300, 40, {190, 180, 150}, random);
  for (int x = 20; x < 1000; x += random.integer(70, 150)) {
    const int height = random.integer(50, 120);
    add_house(picture, {x, 360 - height, random.integer(48, 96), height}, random);
  }
  add_ridge(picture, 368, 14, {70, 130, 110}, random);
  for (int i = 0; i < 16; ++i) {
    const int y = random.integer(365, 480);
    add_tree(picture, {random.integer(0, 1023), y}, 40 + (y - 365), random);
  }
  return picture;
}

}  // namespace tsg::simulation::textures
