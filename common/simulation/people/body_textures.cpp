#include "common/simulation/people/body_textures.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

#include "common/simulation/people/easing.hpp"
#include "common/simulation/people/head_shape.hpp"
#include "common/simulation/people/noise.hpp"
#include "common/simulation/random.hpp"

namespace tsg::simulation {
namespace {

constexpr double kTopAroundM = 0.98;

cv::Scalar shade(const cv::Vec3b& colour, double factor) {
  return {std::min(255.0, factor * colour[0]), std::min(255.0, factor * colour[1]),
          std::min(255.0, factor * colour[2])};
}

/// One colour with soft spots of chance.
cv::Mat mottled(const cv::Vec3b& colour, std::uint64_t seed, int pixels, double amount) {
  cv::Mat image(pixels, pixels, CV_8UC3);
  for (int row = 0; row < pixels; ++row) {
    for (int column = 0; column < pixels; ++column) {
      const double coarse = noise(seed, column * 12.0 / pixels, row * 12.0 / pixels);
      const double fine = noise(seed + 1, column * 90.0 / pixels, row * 90.0 / pixels);
      const cv::Scalar lit = shade(colour, 1.0 + amount * (0.6 * coarse + 0.4 * fine - 0.5));
      image.at<cv::Vec3b>(row, column) = {static_cast<unsigned char>(lit[0]),
                                          static_cast<unsigned char>(lit[1]),
                                          static_cast<unsigned char>(lit[2])};
    }
  }
  return image;
}

/// Pixel of a top's texture: metres right of the middle of the chest as seen, metres below the
/// neck.
cv::Point on_top(const cv::Mat& image, double right_m, double down_m) {
  return {static_cast<int>(std::lround((0.5 + right_m / kTopAroundM) * image.cols)),
          static_cast<int>(std::lround(down_m / static_cast<double>(kTopTextureM) * image.rows))};
}

void draw_buttons(const Look& look, cv::Mat& image) {
  const cv::Scalar seam = shade(look.top_cloth.ground, 0.55);
  for (const double right : {-0.016, 0.016}) {
    cv::line(image, on_top(image, right, 0.05), on_top(image, right, 0.66), seam, 1, cv::LINE_AA);
  }
  for (int button = 0; button < 7; ++button) {
    const double down = 0.09 + 0.085 * button;
    cv::circle(image, on_top(image, 0.0, down), 4, shade(look.top_cloth.second, 0.8), cv::FILLED,
               cv::LINE_AA);
    cv::circle(image, on_top(image, 0.0, down), 2, {235, 240, 240}, cv::FILLED, cv::LINE_AA);
  }
  cv::rectangle(image, on_top(image, 0.055, 0.19), on_top(image, 0.135, 0.29), seam, 1,
                cv::LINE_AA);
}

/// An open jacket: a strip of shirt between two edges with a zip.
void draw_jacket_front(const Look& look, cv::Mat& image) {
  const std::vector<cv::Point> shirt{on_top(image, -0.055, 0.02), on_top(image, 0.055, 0.02),
                                     on_top(image, 0.035, 0.66), on_top(image, -0.035, 0.66)};
  cv::fillConvexPoly(image, shirt, shade(look.top_cloth.second, 1.6), cv::LINE_AA);
  for (int i = 0; i < 9; ++i) {
    cv::line(image, on_top(image, -0.05, 0.1 + 0.06 * i), on_top(image, 0.05, 0.1 + 0.06 * i),
             shade(look.top_cloth.accent, 0.9), 3, cv::LINE_AA);
  }
  const cv::Scalar edge = shade(look.top_cloth.ground, 0.4);
  cv::line(image, shirt[0], shirt[3], edge, 4, cv::LINE_AA);
  cv::line(image, shirt[1], shirt[2], edge, 4, cv::LINE_AA);
  for (const double right : {-0.16, 0.10}) {
    cv::rectangle(image, on_top(image, right, 0.42), on_top(image, right + 0.07, 0.45), edge, 2,
                  cv::LINE_AA);
  }
}

/// A word and a badge on the chest, a number on the back.
void draw_logo(const Look& look, cv::Mat& image) {
  static const std::array<std::string, 6> kWords{"NORTH", "ORBIT", "HILL 7",
                                                 "RIVER", "ATLAS", "LOOP"};
  Random random(look.seed + 77);
  const std::string& word = kWords.at(static_cast<std::size_t>(random.integer(0, 5)));
  const cv::Scalar ink = shade(look.top_cloth.accent, 1.05);
  const cv::Point middle = on_top(image, 0.0, 0.24);
  cv::ellipse(image, middle + cv::Point(0, -22), {38, 30}, 0, 0, 360, ink, 3, cv::LINE_AA);
  cv::line(image, middle + cv::Point(-34, -10), middle + cv::Point(0, -46), ink, 3, cv::LINE_AA);
  cv::line(image, middle + cv::Point(0, -46), middle + cv::Point(34, -10), ink, 3, cv::LINE_AA);
  const cv::Size size = cv::getTextSize(word, cv::FONT_HERSHEY_DUPLEX, 0.8, 2, nullptr);
  cv::putText(image, word, middle + cv::Point(-size.width / 2, 36), cv::FONT_HERSHEY_DUPLEX, 0.8,
              ink, 2, cv::LINE_AA);
  const std::string number = std::to_string(random.integer(10, 99));
  cv::putText(image, number.substr(0, 1), {image.cols - 52, 190}, cv::FONT_HERSHEY_DUPLEX, 2.4, ink,
              6, cv::LINE_AA);
  cv::putText(image, number.substr(1), {2, 190}, cv::FONT_HERSHEY_DUPLEX, 2.4, ink, 6, cv::LINE_AA);
}

void draw_hem(const Look& look, cv::Mat& image) {
  const int hem = image.rows - image.rows / 9;
  cv::line(image, {0, hem}, {image.cols, hem}, shade(look.top_cloth.ground, 0.5), 2, cv::LINE_AA);
}

}  // namespace

cv::Mat paint_top(const Look& look) {
  cv::Mat image = paint_cloth(look.top_cloth, {kTopAroundM, static_cast<double>(kTopTextureM)});
  switch (look.top) {
    case Top::kShirt:
      draw_buttons(look, image);
      break;
    case Top::kJacket:
      draw_jacket_front(look, image);
      break;
    case Top::kTShirt:
    case Top::kJumper:
      if (look.top_cloth.pattern == Pattern::kPlain) draw_logo(look, image);
      break;
  }
  draw_hem(look, image);
  return image;
}

cv::Mat paint_bottom(const Look& look) {
  constexpr double kAroundM = 0.52;
  cv::Mat image = paint_cloth(look.bottom_cloth, {kAroundM, static_cast<double>(kBottomTextureM)});
  if (look.bottom == Bottom::kSkirt) return image;
  const cv::Scalar seam = shade(look.bottom_cloth.ground, 0.55);
  const cv::Scalar thread =
      look.bottom_cloth.pattern == Pattern::kDenim ? cv::Scalar(70, 140, 190) : seam;
  for (const double u : {0.25, 0.75}) {
    const int x = static_cast<int>(u * image.cols);
    cv::line(image, {x, 0}, {x, image.rows}, seam, 2, cv::LINE_AA);
    cv::line(image, {x + 4, 0}, {x + 4, image.rows}, thread, 1, cv::LINE_AA);
  }
  // A back pocket, across the seam of the texture, and the slanting edges of front ones.
  for (const int x : {-34, image.cols - 34}) {
    cv::rectangle(image, cv::Rect(x, 62, 68, 62), thread, 2, cv::LINE_AA);
  }
  for (const int sign : {-1, 1}) {
    const int middle = image.cols / 2;
    cv::line(image, {middle + sign * 70, 40}, {middle + sign * 118, 105}, thread, 2, cv::LINE_AA);
  }
  return image;
}

cv::Mat paint_tights(const Look& look) {
  const bool is_bare = Random(look.seed + 5).chance(0.4);
  return mottled(is_bare ? look.skin : cv::Vec3b(44, 38, 40), look.seed + 6, 128, 0.15);
}

cv::Mat paint_shoe(const Look& look) {
  cv::Mat image = mottled(look.shoes, look.seed + 8, 128, 0.25);
  const cv::Scalar sole = look.shoes[0] > 150 ? cv::Scalar(70, 70, 75) : cv::Scalar(215, 220, 222);
  cv::rectangle(image, cv::Rect(0, 0, 30, 128), sole, cv::FILLED);
  cv::rectangle(image, cv::Rect(98, 0, 30, 128), sole, cv::FILLED);
  for (int i = 0; i < 4; ++i) {
    cv::line(image, {54, 48 + 9 * i}, {74, 48 + 9 * i}, {235, 235, 235}, 2, cv::LINE_AA);
  }
  return image;
}

cv::Mat paint_skin(const Look& look) { return mottled(look.skin, look.seed + 9, 128, 0.14); }

cv::Mat paint_hair(const Look& look) {
  constexpr int kSide = 256;
  cv::Mat image(kSide, kSide, CV_8UC3);
  for (int row = 0; row < kSide; ++row) {
    for (int column = 0; column < kSide; ++column) {
      const double bend = 6.0 * noise(look.seed + 10, column / 40.0, row / 60.0);
      const double strand = noise(look.seed + 11, (column + bend) / 2.2, row / 45.0);
      const double lock = noise(look.seed + 12, (column + bend) / 14.0, row / 80.0);
      const cv::Scalar lit = shade(look.hair_colour, 0.55 + 0.6 * strand + 0.5 * lock);
      image.at<cv::Vec3b>(row, column) = {static_cast<unsigned char>(lit[0]),
                                          static_cast<unsigned char>(lit[1]),
                                          static_cast<unsigned char>(lit[2])};
    }
  }
  return image;
}

}  // namespace tsg::simulation
