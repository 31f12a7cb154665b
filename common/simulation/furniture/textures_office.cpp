#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "common/simulation/furniture/textures.hpp"

namespace tsg::simulation::textures {
namespace {

constexpr int kSpineWidth = 32;
constexpr int kSpineHeight = 256;

/// A spine lying on its side, so that its title can be written: kSpineHeight x kSpineWidth.
cv::Mat lying_spine(Random& random) {
  const bool is_plain = random.chance(0.25);
  const Colour cover = is_plain ? paint::scaled({225, 232, 236}, random.uniform(0.15, 1.0))
                                : paint::any_colour(random);
  const bool is_dark = cover[0] + cover[1] + cover[2] < 390.0;
  const Colour ink = is_dark ? Colour(225, 235, 240) : Colour(35, 35, 40);
  const Colour ornament = paint::any_colour(random);
  cv::Mat spine = paint::flat({kSpineHeight, kSpineWidth}, cover);
  for (const int x : {10, 18, kSpineHeight - 24, kSpineHeight - 14}) {
    if (random.chance(0.6)) paint::fill(spine, {x, 0, random.integer(2, 5), kSpineWidth}, ornament);
  }
  if (random.chance(0.4)) {
    const int x = random.integer(30, 170);
    paint::fill(spine, {x, 0, random.integer(30, 60), kSpineWidth}, paint::scaled(ornament, 0.8));
  }
  paint::write(spine, paint::phrase(random, 2), {random.integer(32, 60), 21},
               random.integer(11, 16), ink);
  cv::circle(spine, {kSpineHeight - 34, kSpineWidth / 2}, 6, ink, random.chance(0.5) ? 2 : -1,
             cv::LINE_AA);
  cv::Mat rounding(spine.size(), CV_32FC1);  // darker towards the joints
  for (int y = 0; y < kSpineWidth; ++y) {
    const double across = (y + 0.5) / kSpineWidth * 2.0 - 1.0;
    rounding.row(y) = -0.45 * std::pow(across, 4.0);
  }
  paint::shade(spine, rounding);
  return spine;
}

/// A hand's line of writing: joined strokes up and down.
void scribble(cv::Mat& picture, cv::Point at, int width, const Colour& ink, Random& random) {
  const int end = at.x + width;
  while (at.x < end) {
    const int letters = random.integer(3, 9);
    for (int i = 0; i < letters && at.x < end; ++i) {
      const cv::Point next(at.x + random.integer(4, 7),
                           at.y + (i % 2 == 0 ? -1 : 1) * random.integer(6, 11));
      cv::line(picture, at, next, ink, 2, cv::LINE_AA);
      at = {next.x, at.y};
    }
    at.x += random.integer(8, 14);
  }
}

void sketch_diagram(cv::Mat& picture, const cv::Rect& area, const Colour& ink, Random& random) {
  cv::Point last(-1, -1);
  for (int i = 0; i < 6; ++i) {
    const cv::Point at(area.x + random.integer(0, area.width - 70),
                       area.y + random.integer(0, area.height - 40));
    if (i % 2 == 0) {
      cv::rectangle(picture, {at.x, at.y, 66, 36}, ink, 2);
    } else {
      cv::ellipse(picture, at + cv::Point(33, 18), {34, 20}, 0, 0, 360, ink, 2, cv::LINE_AA);
    }
    scribble(picture, at + cv::Point(10, 24), 44, ink, random);
    if (last.x >= 0) {
      cv::arrowedLine(picture, last + cv::Point(33, 36), at + cv::Point(33, 0), ink, 2, cv::LINE_AA,
                      0, 0.12);
    }
    last = at;
  }
}

/// One sheet of paper with something on it.
cv::Mat sheet(const cv::Size& size, Random& random) {
  const bool is_coloured = random.chance(0.3);
  const Colour ground = is_coloured
                            ? paint::between(paint::any_colour(random), {255, 255, 255}, 0.5)
                            : Colour(238, 242, 243);
  cv::Mat page = paint::flat(size, ground);
  if (random.chance(0.3)) {
    cv::Mat photo = landscape({size.width - 8, size.height / 2}, random);
    photo.copyTo(page(cv::Rect(4, 4, photo.cols, photo.rows)));
  } else {
    paint::write(page, paint::phrase(random, 1), {6, 22}, random.integer(10, 16),
                 paint::scaled(paint::any_colour(random), 0.6));
  }
  paint::print_lines(page, {6, size.height / 2 + 6, size.width - 12, size.height / 2 - 12}, 7,
                     {80, 80, 80}, random);
  return page;
}

}  // namespace

cv::Mat book_spines(Random& random) {
  cv::Mat atlas(kSpineRows * kSpineHeight, kSpineColumns * kSpineWidth, CV_8UC3);
  for (int i = 0; i < kSpineColumns * kSpineRows; ++i) {
    cv::Mat upright;
    cv::rotate(lying_spine(random), upright, cv::ROTATE_90_CLOCKWISE);
    upright.copyTo(atlas(cv::Rect(i % kSpineColumns * kSpineWidth, i / kSpineColumns * kSpineHeight,
                                  kSpineWidth, kSpineHeight)));
  }
  return atlas;
}

cv::Mat written_board(Random& random) {
  const cv::Size size(1024, 512);
  constexpr std::array<std::array<int, 3>, 4> kPens = {
      {{150, 60, 20}, {40, 40, 190}, {50, 120, 30}, {45, 45, 45}}};
  const auto pen = [&] {
    const auto& bgr = kPens.at(static_cast<std::size_t>(random.integer(0, 3)));
    return Colour(bgr[0], bgr[1], bgr[2]);
  };
  cv::Mat picture = paint::flat(size, {240, 242, 242});
  paint::shade(picture, 0.06 * cv::min(paint::fractal(size, {8, 8}, 4, random), 0.0));
  for (int block = 0; block < 3; ++block) {
    const int x = 40 + 330 * block;
    const Colour ink = pen();
    paint::write(picture, paint::phrase(random, 1), {x, 70}, 28, ink);
    cv::line(picture, {x, 82}, {x + 180, 84}, ink, 3, cv::LINE_AA);
    if (random.chance(0.5)) {
      sketch_diagram(picture, {x, 110, 280, 340}, pen(), random);
      continue;
    }
    const Colour text = pen();
    for (int y = 125; y < 460; y += random.integer(30, 44)) {
      scribble(picture, {x, y}, random.integer(120, 270), text, random);
    }
  }
  return picture;
}

cv::Mat pinned_papers(Random& random) {
  const cv::Size size(512, 512);
  cv::Mat picture = paint::tinted(1.4 * paint::fractal(size, {128, 128}, 2, random), {70, 115, 160},
                                  {130, 175, 212});
  for (int i = 0; i < 16; ++i) {
    const cv::Size paper(random.integer(70, 110), random.integer(80, 130));
    const cv::Point at(10 + i % 4 * 124 + random.integer(-6, 12),
                       8 + i / 4 * 124 + random.integer(-6, 10));
    const cv::Rect area = cv::Rect(at, paper) & cv::Rect(4, 4, 504, 504);
    if (random.chance(0.12)) continue;
    const cv::Mat page = sheet(area.size(), random);
    paint::fill(picture, area + cv::Point(3, 3), {50, 80, 110});  // its shadow
    page.copyTo(picture(area));
    cv::circle(picture, {area.x + area.width / 2, area.y + 6}, 5, paint::any_colour(random),
               cv::FILLED, cv::LINE_AA);
  }
  return picture;
}

cv::Mat newspaper(Random& random) {
  const cv::Size size(256, 256);
  cv::Mat picture = paint::flat(size, {214, 224, 228});
  paint::write(picture, paint::phrase(random, 1), {10, 34}, 24, {30, 30, 30});
  paint::fill(picture, {8, 44, 240, 3}, {40, 40, 40});
  paint::write(picture, paint::phrase(random, 2), {10, 68}, 14, {40, 40, 40});
  landscape({116, 74}, random).copyTo(picture(cv::Rect(10, 78, 116, 74)));
  paint::print_lines(picture, {10, 160, 116, 88}, 6, {90, 90, 90}, random);
  paint::print_lines(picture, {134, 78, 52, 170}, 6, {90, 90, 90}, random);
  paint::print_lines(picture, {194, 78, 52, 170}, 6, {90, 90, 90}, random);
  return picture;
}

cv::Mat clock_face(Random& random) {
  constexpr int kSide = 256;
  constexpr double kCentre = 128.0;
  cv::Mat picture = paint::flat({kSide, kSide}, {240, 242, 243});
  const auto at = [](double turn, double radius) {
    return cv::Point(cvRound(kCentre + radius * std::sin(2.0 * CV_PI * turn)),
                     cvRound(kCentre - radius * std::cos(2.0 * CV_PI * turn)));
  };
  const Colour ink(35, 35, 35);
  for (int minute = 0; minute < 60; ++minute) {
    const bool is_hour = minute % 5 == 0;
    cv::line(picture, at(minute / 60.0, is_hour ? 100.0 : 110.0), at(minute / 60.0, 116.0), ink,
             is_hour ? 5 : 2, cv::LINE_AA);
  }
  for (int hour = 1; hour <= 12; ++hour) {
    const int shift = hour < 10 ? 8 : 16;
    paint::write(picture, std::to_string(hour), at(hour / 12.0, 82.0) + cv::Point(-shift, 9), 18,
                 ink);
  }
  const double time_h = random.uniform(0.0, 12.0);
  cv::line(picture, at(0.0, 0.0), at(time_h / 12.0, 58.0), ink, 8, cv::LINE_AA);
  cv::line(picture, at(0.0, 0.0), at(time_h - std::floor(time_h), 92.0), ink, 5, cv::LINE_AA);
  cv::circle(picture, at(0.0, 0.0), 8, {40, 40, 200}, cv::FILLED, cv::LINE_AA);
  return picture;
}

cv::Mat label(const Colour& colour, Random& random) {
  cv::Mat picture = paint::flat({256, 128}, colour);
  const Colour print = paint::any_colour(random);
  paint::fill(picture, {0, 14, 256, 8}, print);
  paint::fill(picture, {0, 106, 256, 8}, print);
  paint::write(picture, paint::phrase(random, 1), {14, 66}, 24, print);
  paint::print_lines(picture, {16, 76, 96, 24}, 7, paint::scaled(print, 0.6), random);
  for (int i = 0; i < 5; ++i) {
    cv::circle(picture, {170 + 14 * i, 40 + i % 3 * 20}, random.integer(6, 14),
               paint::any_colour(random), cv::FILLED, cv::LINE_AA);
  }
  return picture;
}

}  // namespace tsg::simulation::textures
