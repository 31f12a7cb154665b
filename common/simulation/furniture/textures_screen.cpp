#include <algorithm>
#include <array>
#include <opencv2/imgproc.hpp>

#include "common/simulation/furniture/textures.hpp"

namespace tsg::simulation::textures {
namespace {

const cv::Size kScreenSize(512, 256);

/// Lines of source text, indented and coloured.
void add_code(cv::Mat& picture, const cv::Rect& area, Random& random) {
  constexpr std::array<std::array<int, 3>, 5> kInks = {
      {{200, 200, 205}, {220, 150, 90}, {120, 200, 130}, {110, 170, 230}, {190, 120, 200}}};
  int indent = 0;
  for (int y = area.y + 4; y + 5 < area.br().y; y += 8) {
    indent = std::clamp(indent + random.integer(-1, 1), 0, 4);
    if (random.chance(0.12)) continue;
    int x = area.x + 20 + 12 * indent;
    paint::fill(picture, {area.x + 4, y, 8, 4}, {105, 105, 105});
    const int words = random.integer(1, 7);
    for (int i = 0; i < words; ++i) {
      const auto& ink = kInks.at(static_cast<std::size_t>(random.integer(0, 4)));
      const int width = random.integer(6, 34);
      if (x + width > area.br().x) break;
      paint::fill(picture, {x, y, width, 4}, {double(ink[0]), double(ink[1]), double(ink[2])});
      x += width + 4;
    }
  }
}

void add_window_bar(cv::Mat& picture, const cv::Rect& window, const Colour& colour) {
  paint::fill(picture, {window.x, window.y, window.width, 12}, colour);
  for (int i = 0; i < 3; ++i) {
    cv::circle(picture, {window.br().x - 8 - 11 * i, window.y + 6}, 3, {90, 90, 220}, cv::FILLED,
               cv::LINE_AA);
  }
}

cv::Mat editor(Random& random) {
  cv::Mat picture = paint::flat(kScreenSize, {42, 36, 34});
  paint::fill(picture, {0, 0, 110, 256}, {52, 46, 43});
  for (int y = 18; y < 240; y += 11) {
    paint::fill(picture, {10 + random.integer(0, 2) * 8, y, random.integer(20, 70), 4},
                {150, 145, 140});
  }
  add_code(picture, {114, 14, 250, 180}, random);
  paint::fill(picture, {370, 12, 142, 244}, {36, 31, 30});
  add_code(picture, {372, 14, 138, 238}, random);
  paint::fill(picture, {112, 198, 256, 58}, {26, 22, 20});
  add_code(picture, {114, 200, 250, 54}, random);
  add_window_bar(picture, {0, 0, 512, 256}, {70, 62, 58});
  return picture;
}

cv::Mat web_page(Random& random) {
  const Colour accent = paint::any_colour(random);
  cv::Mat picture = paint::flat(kScreenSize, {246, 246, 246});
  paint::fill(picture, {0, 12, 512, 34}, accent);
  paint::write(picture, paint::phrase(random, 1), {14, 36}, 16, {250, 250, 250});
  paint::write(picture, paint::phrase(random, 2), {14, 72}, 13, {40, 40, 40});
  landscape({180, 100}, random).copyTo(picture(cv::Rect(320, 58, 180, 100)));
  paint::print_lines(picture, {14, 84, 290, 80}, 8, {90, 90, 90}, random);
  for (int i = 0; i < 4; ++i) {
    const cv::Rect card(14 + 124 * i, 172, 112, 74);
    paint::fill(picture, card, paint::between(paint::any_colour(random), {255, 255, 255}, 0.4));
    paint::print_lines(picture, {card.x + 6, card.y + 44, 98, 26}, 8, {80, 80, 80}, random);
  }
  add_window_bar(picture, {0, 0, 512, 256}, {215, 212, 210});
  return picture;
}

void fill_cell(cv::Mat& picture, const cv::Point& at, Random& random) {
  cv::rectangle(picture, cv::Rect(at, cv::Size(53, 13)), {200, 200, 200}, 1);
  if (random.chance(0.12)) {
    paint::fill(picture, {at.x + 1, at.y + 1, 50, 10},
                paint::between(paint::any_colour(random), {255, 255, 255}, 0.5));
  }
  if (random.chance(0.7)) {
    paint::fill(picture, {at.x + 5, at.y + 4, random.integer(12, 42), 4}, {70, 70, 70});
  }
}

cv::Mat spreadsheet(Random& random) {
  cv::Mat picture = paint::flat(kScreenSize, {250, 250, 250});
  paint::fill(picture, {0, 12, 512, 22}, {90, 135, 60});
  constexpr int kColumns = 10;
  constexpr int kRows = 19;
  for (int i = 0; i < kColumns * kRows; ++i) {
    fill_cell(picture, {i % kColumns * 52, 34 + i / kColumns * 12}, random);
  }
  paint::fill(picture, {300, 90, 190, 120}, {255, 255, 255});
  cv::rectangle(picture, {300, 90, 190, 120}, {130, 130, 130}, 1);
  for (int i = 0; i < 9; ++i) {
    const int height = random.integer(15, 100);
    paint::fill(picture, {312 + 19 * i, 204 - height, 13, height}, paint::any_colour(random));
  }
  add_window_bar(picture, {0, 0, 512, 256}, {215, 212, 210});
  return picture;
}

cv::Mat desktop(Random& random) {
  cv::Mat picture = landscape(kScreenSize, random);
  for (int i = 0; i < 12; ++i) {
    const cv::Rect icon(12 + i / 6 * 40, 12 + i % 6 * 36, 20, 20);
    paint::fill(picture, icon, paint::any_colour(random));
    paint::fill(picture, {icon.x - 3, icon.y + 23, 26, 3}, {240, 240, 240});
  }
  const cv::Rect window(150, 40, 250, 160);
  paint::fill(picture, window, {245, 245, 245});
  paint::print_lines(picture, {160, 64, 230, 126}, 9, {90, 90, 90}, random);
  add_window_bar(picture, window, {200, 160, 120});
  paint::fill(picture, {0, 244, 512, 12}, {50, 42, 40});
  return picture;
}

}  // namespace

cv::Mat screen(Random& random) {
  constexpr std::array kKinds = {&editor, &web_page, &spreadsheet, &desktop};
  return kKinds.at(static_cast<std::size_t>(random.integer(0, kKinds.size() - 1)))(random);
}

cv::Mat key_caps(Random& random) {
  const bool is_dark = random.chance(0.7);
  const Colour cap = is_dark ? Colour(52, 50, 48) : Colour(215, 220, 222);
  const Colour letter = is_dark ? Colour(220, 220, 220) : Colour(60, 60, 60);
  constexpr int kSide = 128;
  constexpr int kKey = kSide / 4;
  cv::Mat picture = paint::flat({kSide, kSide}, cap);
  for (int i = 0; i < 16; ++i) {
    const cv::Point corner(i % 4 * kKey, i / 4 * kKey);
    const auto code = static_cast<char>('A' + random.integer(0, 25));
    paint::write(picture, std::string(1, code), corner + cv::Point(7, 20), 13, letter);
  }
  return picture;
}

}  // namespace tsg::simulation::textures
