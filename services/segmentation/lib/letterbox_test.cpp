#include "services/segmentation/lib/letterbox.hpp"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

namespace tsg {
namespace {

cv::Mat noise_image(cv::Size size, int seed) {
  cv::RNG random(static_cast<std::uint64_t>(seed));
  cv::Mat image(size, CV_8UC3);
  random.fill(image, cv::RNG::UNIFORM, 0, 256);
  return image;
}

float tensor_at(const std::vector<float>& tensor, cv::Size size, int channel, cv::Point at) {
  const int index = (channel * size.height + at.y) * size.width + at.x;
  return tensor[static_cast<std::size_t>(index)];
}

/// As YOLO networks are shown images: red first, 0..1, centred between bars of grey.
InputFormat plain(cv::Size size) {
  return {.size = size, .border = cv::Vec3f::all(114.0F / 255.0F)};
}

/// As RTMDet is: blue first, normalised, at the top left, beside it grey.
InputFormat normalised(cv::Size size) {
  return {.size = size,
          .order = ChannelOrder::kBgr,
          .placement = Placement::kTopLeft,
          .mean = {100.0F, 110.0F, 120.0F},
          .deviation = {50.0F, 60.0F, 70.0F},
          .border = {0.28F, 4.0F / 60.0F, -6.0F / 70.0F}};  // 114
}

std::vector<float> tensor_of(const cv::Mat& bgr, const InputFormat& format) {
  std::vector<float> tensor(static_cast<std::size_t>(3 * format.size.area()), -1.0F);
  InputTensorWriter(bgr.size(), format).write(bgr, tensor);
  return tensor;
}

/// The same conversion in the steps of OpenCV.
cv::Mat reference_input(const cv::Mat& bgr, const InputFormat& format) {
  cv::Mat as_float;
  bgr.convertTo(as_float, CV_32FC3);
  cv::Mat resized;
  const Letterbox letterbox = make_letterbox(bgr.size(), format.size, format.placement);
  cv::resize(as_float, resized, letterbox.image.size(), 0, 0, cv::INTER_LINEAR);
  cv::Mat input(letterbox.input_size, CV_32FC3, cv::Scalar::all(114));
  resized.copyTo(input(letterbox.image));
  if (format.order == ChannelOrder::kRgb) cv::cvtColor(input, input, cv::COLOR_BGR2RGB);
  const auto as_scalar = [](const cv::Vec3f& v) { return cv::Scalar(v[0], v[1], v[2]); };
  cv::subtract(input, as_scalar(format.mean), input);
  cv::divide(input, as_scalar(format.deviation), input);
  return input;
}

void expect_equals_reference(cv::Size frame_size, const InputFormat& format) {
  const cv::Mat image = noise_image(frame_size, 7);
  std::vector<float> tensor = tensor_of(image, format);
  const cv::Mat expected = reference_input(image, format);
  for (int channel = 0; channel < 3; ++channel) {
    const auto first = static_cast<std::ptrdiff_t>(channel) * format.size.area();
    const cv::Mat plane(format.size, CV_32FC1, tensor.data() + first);
    cv::Mat expected_plane;
    cv::extractChannel(expected, expected_plane, channel);
    EXPECT_LT(cv::norm(plane, expected_plane, cv::NORM_INF), 2e-4)
        << "channel " << channel << " of a frame of " << frame_size;
  }
}

TEST(Letterbox, LeavesAFrameOfTheInputsSizeAsItIs) {
  const Letterbox letterbox = make_letterbox({640, 480}, {640, 480});
  EXPECT_EQ(letterbox.image, cv::Rect(0, 0, 640, 480));
  EXPECT_EQ(letterbox.to_frame({10.0F, 20.0F, 30.0F, 40.0F}), cv::Rect2f(10, 20, 30, 40));
}

TEST(Letterbox, CentresAWideFrameBetweenBars) {
  const Letterbox letterbox = make_letterbox({1280, 720}, {640, 640});
  EXPECT_EQ(letterbox.image, cv::Rect(0, 140, 640, 360));
}

TEST(Letterbox, PutsAFrameAtTheTopLeftOfANetworkThatWantsItThere) {
  const Letterbox letterbox = make_letterbox({1280, 720}, {640, 640}, Placement::kTopLeft);
  EXPECT_EQ(letterbox.image, cv::Rect(0, 0, 640, 360));
  EXPECT_EQ(letterbox.to_frame({320.0F, 180.0F, 10.0F, 20.0F}), cv::Rect2f(640, 360, 20, 40));
}

TEST(Letterbox, MapsBoxesBackToTheFrameAndCutsThemToIt) {
  const Letterbox letterbox = make_letterbox({1280, 720}, {640, 640});
  EXPECT_EQ(letterbox.to_frame({320.0F, 320.0F, 10.0F, 20.0F}), cv::Rect2f(640, 360, 20, 40));
  EXPECT_EQ(letterbox.to_frame({-20.0F, 0.0F, 700.0F, 640.0F}), cv::Rect2f(0, 0, 1280, 720));
}

TEST(InputTensorWriter, TurnsPixelsToPlanesOfRedGreenAndBlue) {
  const cv::Mat image(2, 2, CV_8UC3, cv::Scalar(255, 51, 0));  // BGR
  const std::vector<float> tensor = tensor_of(image, plain({2, 2}));
  EXPECT_FLOAT_EQ(tensor_at(tensor, {2, 2}, 0, {1, 0}), 0.0F);
  EXPECT_FLOAT_EQ(tensor_at(tensor, {2, 2}, 1, {0, 1}), 0.2F);
  EXPECT_FLOAT_EQ(tensor_at(tensor, {2, 2}, 2, {1, 1}), 1.0F);
}

TEST(InputTensorWriter, EqualsResizingAndConvertingStepByStep) {
  for (const auto& format : {plain, normalised}) {
    expect_equals_reference({64, 48}, format({64, 48}));   // as is
    expect_equals_reference({64, 48}, format({64, 64}));   // bars above and below
    expect_equals_reference({128, 72}, format({64, 64}));  // halved, with bars
    expect_equals_reference({48, 64}, format({64, 64}));   // bars left and right
    expect_equals_reference({50, 37}, format({96, 64}));   // enlarged by an odd factor
    expect_equals_reference({101, 67}, format({64, 32}));  // shrunk by an odd factor
  }
}

TEST(InputTensorWriter, ReadsAViewWithRowsFartherApartThanItsWidth) {
  const cv::Mat large = noise_image({80, 60}, 3);
  const cv::Mat view = large(cv::Rect(8, 6, 64, 48));
  const InputFormat format = plain({64, 48});
  EXPECT_EQ(tensor_of(view, format), tensor_of(view.clone(), format));
}

}  // namespace
}  // namespace tsg
