#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "common/simulation/furniture/textures.hpp"

namespace tsg::simulation::textures {
namespace {

constexpr int kBoardSide = 512;
constexpr int kFloorSide = 1024;

/// Dark and light parts of the grain.
std::pair<Colour, Colour> colours_of(Wood kind) {
  switch (kind) {
    case Wood::kBirch:
      return {{132, 172, 205}, {172, 208, 232}};
    case Wood::kOak:
      return {{70, 112, 152}, {116, 160, 198}};
    case Wood::kBeech:
      return {{88, 132, 182}, {128, 172, 214}};
    case Wood::kWalnut:
      return {{32, 50, 76}, {62, 88, 122}};
    case Wood::kWhite:
      break;
  }
  return {{216, 222, 224}, {234, 238, 240}};
}

/// Year rings cut lengthwise: bands of stretched noise, and fine pores.
cv::Mat grain(const cv::Size& size, Random& random) {
  const cv::Mat bend = paint::fractal(size, {8, 2}, 3, random);
  const cv::Mat fibres = paint::fractal(size, {size.width / 4, 4}, 2, random);
  cv::Mat weight(size, CV_32FC1);
  for (int y = 0; y < size.height; ++y) {
    const auto* const bend_row = bend.ptr<float>(y);
    const auto* const fibre_row = fibres.ptr<float>(y);
    auto* const row = weight.ptr<float>(y);
    for (int x = 0; x < size.width; ++x) {
      const float ring = std::sin(22.0F * bend_row[x]);
      row[x] = 0.45F * ring + 0.3F * bend_row[x] + 0.65F * fibre_row[x];
    }
  }
  return weight;
}

/// One board on a floor: a piece of `source`, lighter or darker, with dark joints.
void lay_board(cv::Mat& picture, const cv::Rect& area, const cv::Mat& source, Random& random) {
  cv::Mat board = paint::cut(source, area.size(), random);
  board *= random.uniform(0.78, 1.08);
  const cv::Rect whole({0, 0}, board.size());
  const Colour joint = cv::mean(board) * 0.45;
  cv::rectangle(board, whole, joint, 1);
  const cv::Rect visible = area & cv::Rect({0, 0}, picture.size());
  if (visible.empty()) return;  // its end is at the picture's edge
  board(visible - area.tl()).copyTo(picture(visible));
}

}  // namespace

Wood any_wood(Random& random) {
  constexpr std::array kKinds = {Wood::kBirch, Wood::kOak, Wood::kBeech, Wood::kWalnut,
                                 Wood::kWhite};
  return kKinds.at(static_cast<std::size_t>(random.integer(0, kKinds.size() - 1)));
}

cv::Mat wood(Wood kind, Random& random) {
  const auto [dark, light] = colours_of(kind);
  return paint::tinted(grain({kBoardSide, kBoardSide}, random), dark, light);
}

cv::Mat planks(Wood kind, Random& random) {
  constexpr int kAcross = 16;
  constexpr int kWidth = kFloorSide / kAcross;
  constexpr int kLength = kFloorSide / 2;
  const cv::Mat source = wood(kind, random);
  cv::Mat picture = paint::flat({kFloorSide, kFloorSide}, {});
  for (int column = 0; column < kAcross; ++column) {
    const int begin = random.integer(0, kLength - 1);
    // The board across the seam is laid twice with the same chance, so that it has none.
    Random board_at_seam(random.next());
    Random same_again = board_at_seam;
    lay_board(picture, {column * kWidth, begin - kLength, kWidth, kLength}, source, board_at_seam);
    lay_board(picture, {column * kWidth, begin, kWidth, kLength}, source, random);
    lay_board(picture, {column * kWidth, begin + kLength, kWidth, kLength}, source, same_again);
  }
  return picture;
}

cv::Mat parquet(Wood kind, Random& random) {
  constexpr int kBlocks = 8;  // blocks across
  constexpr int kBlock = kFloorSide / kBlocks;
  constexpr int kSticks = 4;  // in a block
  constexpr int kStick = kBlock / kSticks;
  const cv::Mat upright = wood(kind, random);
  cv::Mat lying;
  cv::rotate(upright, lying, cv::ROTATE_90_CLOCKWISE);
  cv::Mat picture = paint::flat({kFloorSide, kFloorSide}, {});
  for (int i = 0; i < kBlocks * kBlocks * kSticks; ++i) {
    const int block = i / kSticks;
    const cv::Point corner(block % kBlocks * kBlock, block / kBlocks * kBlock);
    const int offset = i % kSticks * kStick;
    if ((block % kBlocks + block / kBlocks) % 2 == 0) {
      lay_board(picture, {corner.x + offset, corner.y, kStick, kBlock}, upright, random);
    } else {
      lay_board(picture, {corner.x, corner.y + offset, kBlock, kStick}, lying, random);
    }
  }
  return picture;
}

}  // namespace tsg::simulation::textures
