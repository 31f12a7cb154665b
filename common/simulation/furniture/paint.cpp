#include "common/simulation/furniture/paint.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <string_view>

#include "common/core/check.hpp"

namespace tsg::simulation::paint {

Colour hsv(double hue_deg, double saturation, double value) {
  const auto channel = [&](double offset) {
    const double k = std::fmod(offset + hue_deg / 60.0, 6.0);
    const double dip = std::clamp(std::min(k, 4.0 - k), 0.0, 1.0);
    return 255.0 * value * (1.0 - saturation * dip);
  };
  return {channel(1.0), channel(3.0), channel(5.0)};
}

Colour between(const Colour& colour, const Colour& other, double share) {
  return colour * (1.0 - share) + other * share;
}

Colour scaled(const Colour& colour, double factor) {
  Colour result;
  for (int i = 0; i < 3; ++i) result[i] = std::clamp(colour[i] * factor, 0.0, 255.0);
  return result;
}

Colour any_colour(Random& random) {
  // Hues that things are sold in: reds to yellows, greens, blues; hardly any violet.
  constexpr std::array<double, 10> kHues = {2.0,   12.0,  28.0,  45.0,  90.0,
                                            150.0, 185.0, 208.0, 222.0, 335.0};
  const auto index = static_cast<std::size_t>(random.integer(0, kHues.size() - 1));
  const double hue = kHues.at(index) + random.uniform(0.0, 12.0);
  return hsv(hue, random.uniform(0.35, 0.78), random.uniform(0.3, 0.82));
}

cv::Mat flat(const cv::Size& size, const Colour& colour) { return {size, CV_8UC3, colour}; }

cv::Mat noise(const cv::Size& size, const cv::Size& cells, Random& random) {
  TSG_CHECK(size.width % cells.width == 0 && size.height % cells.height == 0);
  cv::Mat grid(cells, CV_32FC1);
  cv::Mat_<float> values(grid);  // shares the pixels
  for (int i = 0; i < grid.rows * grid.cols; ++i) {
    values(i / grid.cols, i % grid.cols) = static_cast<float>(random.uniform(-1.0, 1.0));
  }
  if (cells == size) return grid;
  constexpr int kBorder = 2;  // what cubic interpolation reaches
  cv::Mat padded;
  cv::copyMakeBorder(grid, padded, kBorder, kBorder, kBorder, kBorder, cv::BORDER_WRAP);
  const cv::Size step(size.width / cells.width, size.height / cells.height);
  cv::Mat wide;
  cv::resize(padded, wide, {padded.cols * step.width, padded.rows * step.height}, 0, 0,
             cv::INTER_CUBIC);
  return wide(cv::Rect({kBorder * step.width, kBorder * step.height}, size)).clone();
}

cv::Mat fractal(const cv::Size& size, const cv::Size& cells, int octaves, Random& random) {
  cv::Mat sum = cv::Mat::zeros(size, CV_32FC1);
  cv::Size now = cells;
  double strength = 1.0;
  double total = 0.0;
  for (int i = 0; i < octaves; ++i) {
    cv::scaleAdd(noise(size, now, random), strength, sum, sum);
    total += strength;
    strength *= 0.5;
    now = {std::min(2 * now.width, size.width), std::min(2 * now.height, size.height)};
  }
  sum *= 1.0 / total;
  return sum;
}

cv::Mat tinted(const cv::Mat& weight, const Colour& dark, const Colour& light) {
  std::array<cv::Mat, 3> channels;
  for (int i = 0; i < 3; ++i) {
    const double half_range = 0.5 * (light[i] - dark[i]);
    weight.convertTo(channels.at(static_cast<std::size_t>(i)), CV_8U, half_range,
                     dark[i] + half_range);
  }
  cv::Mat picture;
  cv::merge(channels, picture);
  return picture;
}

void shade(cv::Mat& picture, const cv::Mat& weight) {
  cv::Mat factor;
  cv::Mat light;
  cv::merge(std::array<cv::Mat, 3>{weight, weight, weight}, factor);
  picture.convertTo(light, CV_32FC3);
  cv::Mat(light + light.mul(factor)).convertTo(picture, CV_8UC3);
}

cv::Mat cut(const cv::Mat& source, const cv::Size& size, Random& random) {
  const int x0 = random.integer(0, source.cols - 1);
  const int y0 = random.integer(0, source.rows - 1);
  cv::Mat sheet(size, source.type());
  for (int y = 0; y < size.height; ++y) {
    const auto* const from = source.ptr<cv::Vec3b>((y0 + y) % source.rows);
    auto* const to = sheet.ptr<cv::Vec3b>(y);
    for (int x = 0; x < size.width; ++x) to[x] = from[(x0 + x) % source.cols];
  }
  return sheet;
}

void fill(cv::Mat& picture, const cv::Rect& area, const Colour& colour) {
  cv::rectangle(picture, area, colour, cv::FILLED);
}

void line(cv::Mat& picture, const cv::Point& from, const cv::Point& to, const Colour& colour) {
  cv::line(picture, from, to, colour, 1, cv::LINE_AA);
}

std::string word(Random& random) {
  constexpr std::array<std::string_view, 24> kSyllables = {
      "la", "ro", "mi", "ten", "sor", "vec", "ta",  "li", "ne", "gra", "ph",  "on",
      "di", "ka", "lu", "mer", "sta", "tic", "pro", "be", "an", "int", "ver", "es"};
  std::string text;
  const int count = random.integer(1, 4);
  for (int i = 0; i < count; ++i) {
    text += kSyllables.at(static_cast<std::size_t>(random.integer(0, kSyllables.size() - 1)));
  }
  return text;
}

std::string phrase(Random& random, int count) {
  std::string text;
  for (int i = 0; i < count; ++i) text += (i == 0 ? "" : " ") + word(random);
  text.front() = static_cast<char>(text.front() - 'a' + 'A');
  return text;
}

void write(cv::Mat& picture,
           const std::string& text,
           const cv::Point& at,
           int height,
           const Colour& colour) {
  constexpr double kLetterPixels = 21.0;  // of a capital in this font at scale 1
  const int thickness = std::max(1, height / 10);
  cv::putText(picture, text, at, cv::FONT_HERSHEY_SIMPLEX, height / kLetterPixels, colour,
              thickness, cv::LINE_AA);
}

void print_lines(
    cv::Mat& picture, const cv::Rect& area, int pitch, const Colour& ink, Random& random) {
  for (int y = area.y; y + pitch / 2 < area.br().y; y += pitch) {
    const bool is_last = random.chance(0.15);
    const int end = is_last ? area.x + area.width / 2 : area.br().x;
    for (int x = area.x; x < end;) {
      const int width = std::min(random.integer(pitch / 2, 4 * pitch), end - x);
      fill(picture, {x, y, width, std::max(1, pitch / 2)}, scaled(ink, random.uniform(0.7, 1.4)));
      x += width + std::max(1, pitch / 3);
    }
  }
}

}  // namespace tsg::simulation::paint
