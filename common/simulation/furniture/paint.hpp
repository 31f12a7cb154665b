#pragma once

#include <opencv2/core.hpp>
#include <string>

#include "common/simulation/random.hpp"

/// The primitives that all procedural pictures are made with. Pictures are CV_8UC3, BGR; colours
/// are BGR codes of 0..255; weights are CV_32FC1.
namespace tsg::simulation::paint {

using Colour = cv::Scalar;

/// Hue in degrees, saturation and value 0..1.
[[nodiscard]] Colour hsv(double hue_deg, double saturation, double value);
/// Towards `other` by `share` (0..1).
[[nodiscard]] Colour between(const Colour& colour, const Colour& other, double share);
/// Lighter (> 1) or darker (< 1), within the range of codes.
[[nodiscard]] Colour scaled(const Colour& colour, double factor);
/// One of a cloth's, cover's or poster's colours: anything but grey.
[[nodiscard]] Colour any_colour(Random& random);

[[nodiscard]] cv::Mat flat(const cv::Size& size, const Colour& colour);

/// Smooth noise of about -1..1 that repeats at the edges; `cells` bumps across and down, each a
/// power of two up to the size's.
[[nodiscard]] cv::Mat noise(const cv::Size& size, const cv::Size& cells, Random& random);
/// Sum of noises, each with twice the cells and half the strength of the one before.
[[nodiscard]] cv::Mat fractal(const cv::Size& size,
                              const cv::Size& cells,
                              int octaves,
                              Random& random);
/// `dark` where the weight is -1, `light` where it is 1.
[[nodiscard]] cv::Mat tinted(const cv::Mat& weight, const Colour& dark, const Colour& light);
/// Multiplies every pixel by 1 + `weight`.
void shade(cv::Mat& picture, const cv::Mat& weight);
/// A sheet of `size` cut from `source` at a random place, wrapped around its edges.
[[nodiscard]] cv::Mat cut(const cv::Mat& source, const cv::Size& size, Random& random);

void fill(cv::Mat& picture, const cv::Rect& area, const Colour& colour);
void line(cv::Mat& picture, const cv::Point& from, const cv::Point& to, const Colour& colour);

/// A word that could be one.
[[nodiscard]] std::string word(Random& random);
/// `count` words, the first with a capital.
[[nodiscard]] std::string phrase(Random& random, int count);
/// Writes `text` with its lower left corner at `at`, letters `height` pixels high.
void write(cv::Mat& picture,
           const std::string& text,
           const cv::Point& at,
           int height,
           const Colour& colour);
/// Grey lines of words over `area`, `pitch` pixels apart, as print looks from afar.
void print_lines(
    cv::Mat& picture, const cv::Rect& area, int pitch, const Colour& ink, Random& random);

}  // namespace tsg::simulation::paint
