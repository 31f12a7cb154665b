#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "common/simulation/people/body_textures.hpp"
#include "common/simulation/people/head_shape.hpp"
#include "common/simulation/people/noise.hpp"

namespace tsg::simulation {
namespace {

constexpr int kSide = 512;
constexpr int kShift = 4;  // sub-pixel bits of OpenCV's drawing

/// Draws on a face in metres: y to its left, z up (of a body of 1.75 m).
class FacePainter {
 public:
  explicit FacePainter(cv::Mat& image) : image_(image) {}

  [[nodiscard]] static cv::Point pixel(double y_m, double z_m) {
    constexpr double kUnits = 1 << kShift;
    return {static_cast<int>(std::lround(face_u(y_m) * kSide * kUnits)),
            static_cast<int>(std::lround(face_v(z_m) * kSide * kUnits))};
  }
  /// Half axes in metres across and up.
  void ellipse(const cv::Point2d& at_m, const cv::Size2d& half_m, const cv::Scalar& colour) const {
    const cv::Point middle = pixel(at_m.x, at_m.y);
    const cv::Point right = pixel(at_m.x + half_m.width, at_m.y);
    const cv::Point top = pixel(at_m.x, at_m.y + half_m.height);
    cv::ellipse(image_, middle, {right.x - middle.x, middle.y - top.y}, 0, 0, 360, colour,
                cv::FILLED, cv::LINE_AA, kShift);
  }
  void line(const cv::Point2d& from_m,
            const cv::Point2d& to_m,
            const cv::Scalar& colour,
            int pixels) const {
    cv::line(image_, pixel(from_m.x, from_m.y), pixel(to_m.x, to_m.y), colour, pixels, cv::LINE_AA,
             kShift);
  }

 private:
  cv::Mat& image_;
};

cv::Scalar tinted(const cv::Vec3b& colour, const cv::Scalar& factors) {
  return {std::min(255.0, factors[0] * colour[0]), std::min(255.0, factors[1] * colour[1]),
          std::min(255.0, factors[2] * colour[2])};
}

void paint_soft_parts(const Look& look, const FacePainter& face) {
  for (const double side : {-1.0, 1.0}) {
    face.ellipse({side * 0.042, 1.598}, {0.020, 0.016}, tinted(look.skin, {0.90, 0.90, 1.03}));
    face.ellipse({side * kEyeAsideM, kEyeHeightM}, {0.021, 0.013},
                 tinted(look.skin, {0.80, 0.82, 0.86}));
    face.ellipse({side * 0.008, 1.592}, {0.006, 0.004}, tinted(look.skin, {0.55, 0.55, 0.62}));
  }
  face.ellipse({0.0, 1.588}, {0.015, 0.004}, tinted(look.skin, {0.74, 0.74, 0.80}));
  face.ellipse({0.0, 1.549}, {0.020, 0.004}, tinted(look.skin, {0.80, 0.80, 0.85}));
  if (!look.has_beard) return;
  const auto hair_on_skin = [&look](double hair) {
    const cv::Vec3b mix = look.skin * (1.0 - hair) + look.hair_colour * hair;
    return cv::Scalar(mix[0], mix[1], mix[2]);
  };
  face.ellipse({0.0, 1.528}, {0.070, 0.044}, hair_on_skin(0.55));
  face.ellipse({0.0, 1.531}, {0.036, 0.020}, hair_on_skin(0.8));
  for (const double side : {-1.0, 1.0}) {
    face.ellipse({side * 0.042, 1.592}, {0.023, 0.024}, tinted(look.skin, {1.0, 1.0, 1.0}));
  }
  face.ellipse({0.0, 1.580}, {0.026, 0.006}, hair_on_skin(0.8));
}

void paint_eye(const Look& look, double side, const FacePainter& face) {
  const double y = side * kEyeAsideM;
  face.ellipse({y, kEyeHeightM}, {0.0145, 0.0068}, {30, 30, 38});
  face.ellipse({y, kEyeHeightM - 0.0006}, {0.0130, 0.0055}, {226, 230, 232});
  face.ellipse({y, kEyeHeightM}, {0.0062, 0.0058}, tinted(look.eyes, {1.0, 1.0, 1.0}));
  face.ellipse({y, kEyeHeightM}, {0.0030, 0.0030}, {12, 12, 12});
  face.ellipse({y + 0.002, kEyeHeightM + 0.002}, {0.0011, 0.0011}, {250, 250, 250});
  const cv::Scalar brow = tinted(look.hair_colour, {0.85, 0.85, 0.85});
  face.line({y - side * 0.014, 1.6545}, {y + side * 0.004, 1.6590}, brow, 8);
  face.line({y + side * 0.004, 1.6590}, {y + side * 0.018, 1.6545}, brow, 6);
}

void paint_mouth(const Look& look, const FacePainter& face) {
  const double red = look.is_feminine ? 1.02 : 0.95;
  const cv::Scalar lips = tinted(look.skin, {0.60, 0.58, red});
  face.ellipse({0.0, kMouthHeightM + 0.003}, {0.022, 0.0042}, lips);
  face.ellipse({0.0, kMouthHeightM - 0.004}, {0.019, 0.0058}, lips);
  face.line({-0.023, kMouthHeightM}, {0.023, kMouthHeightM}, tinted(look.skin, {0.3, 0.3, 0.4}), 2);
}

void paint_glasses(const FacePainter& face) {
  const cv::Scalar frame(28, 26, 30);
  for (const double side : {-1.0, 1.0}) {
    const double y = side * kEyeAsideM;
    const std::array<cv::Point2d, 4> corners{
        {{y - 0.021, 1.651}, {y + 0.021, 1.651}, {y + 0.021, 1.621}, {y - 0.021, 1.621}}};
    for (std::size_t i = 0; i < 4; ++i) {
      face.line(corners.at(i), corners.at((i + 1) % 4), frame, 5);
    }
    face.line({side * 0.052, 1.647}, {side * 0.0735, 1.645}, frame, 5);
  }
  face.line({-0.010, 1.645}, {0.010, 1.645}, frame, 5);
}

}  // namespace

cv::Mat paint_face(const Look& look) {
  cv::Mat image(kSide, kSide, CV_8UC3, cv::Scalar(look.skin[0], look.skin[1], look.skin[2]));
  const FacePainter face(image);
  paint_soft_parts(look, face);
  cv::GaussianBlur(image, image, {0, 0}, 7.0);
  paint_mouth(look, face);
  for (const double side : {-1.0, 1.0}) paint_eye(look, side, face);
  cv::GaussianBlur(image, image, {0, 0}, 0.8);
  if (look.has_glasses) paint_glasses(face);
  for (int row = 0; row < kSide; ++row) {
    for (int column = 0; column < kSide; ++column) {
      const double spots = 0.97 + 0.06 * noise(look.seed + 20, column / 5.0, row / 5.0);
      image.at<cv::Vec3b>(row, column) *= spots;
    }
  }
  return image;
}

}  // namespace tsg::simulation
