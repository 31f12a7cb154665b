#include "services/segmentation/lib/decoders/mask_painter.hpp"

#include <algorithm>
#include <cstddef>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <span>
#include <utility>

namespace tsg {

namespace {

/// One axis of sample_whole_frame(): `first_input` and `input_length` say where the image lies.
std::vector<MaskTap> taps_of_axis(
    int frame_length, int first_input, int input_length, int step, int samples) {
  std::vector<MaskTap> taps(static_cast<std::size_t>(frame_length));
  const double scale = static_cast<double>(input_length) / frame_length;
  const auto in_mask = [&](int input) {
    return linear_tap((first_input + input + 0.5) / step - 0.5, samples);
  };
  for (std::size_t i = 0; i < taps.size(); ++i) {
    const LinearTap outer = linear_tap((static_cast<double>(i) + 0.5) * scale - 0.5, input_length);
    taps[i].first = in_mask(outer.first).first;
    taps[i].weights = {};
    const auto add = [&](const LinearTap& inner, float share) {
      taps[i].weights.at(static_cast<std::size_t>(inner.first - taps[i].first)) +=
          share * (1.0F - inner.weight_of_second);
      taps[i].weights.at(static_cast<std::size_t>(inner.second - taps[i].first)) +=
          share * inner.weight_of_second;
    };
    add(in_mask(outer.first), 1.0F - outer.weight_of_second);
    add(in_mask(outer.second), outer.weight_of_second);
  }
  return taps;
}

/// The taps that touch samples first..last: begin and end in `taps`.
std::pair<int, int> touching(const std::vector<MaskTap>& taps, int first, int last) {
  constexpr int kReach = 2;  // samples beyond the first that a tap takes
  const auto begin = std::partition_point(
      taps.begin(), taps.end(), [&](const MaskTap& tap) { return tap.first + kReach < first; });
  const auto end = std::partition_point(begin, taps.end(),
                                        [&](const MaskTap& tap) { return tap.first <= last; });
  return {static_cast<int>(begin - taps.begin()), static_cast<int>(end - taps.begin())};
}

/// One row of the mask's samples between rows of these.
void blend_rows(const MaskPart& mask, const MaskTap& tap, std::span<float> blended) {
  std::array<const float*, 3> rows{};
  for (int i = 0; i < 3; ++i) {  // beyond the last row weights are 0
    const int row = std::min(tap.first - mask.origin.y + i, mask.values.rows - 1);
    rows.at(static_cast<std::size_t>(i)) = mask.values.ptr<float>(row);
  }
  const auto [upper, middle, lower] = rows;
  const auto [of_upper, of_middle, of_lower] = tap.weights;
  for (std::size_t x = 0; x < static_cast<std::size_t>(mask.values.cols); ++x) {
    blended[x] = of_upper * upper[x] + of_middle * middle[x] + of_lower * lower[x];
  }
}

/// Columns first and last of a row in which something was written; last < first: nothing was.
struct Written {
  int first;
  int last;
};

Written paint_row(std::span<const float> blended,
                  std::span<const MaskTap> columns,
                  std::uint8_t label,
                  std::uint8_t* labels) {
  Written written{static_cast<int>(columns.size()), -1};
  for (std::size_t x = 0; x < columns.size(); ++x) {
    const MaskTap& tap = columns[x];
    const float* samples = blended.data() + tap.first;
    const float probability =
        tap.weights[0] * samples[0] + tap.weights[1] * samples[1] + tap.weights[2] * samples[2];
    if (!(probability > 0.5F)) continue;
    labels[x] = label;
    written.first = std::min(written.first, static_cast<int>(x));
    written.last = static_cast<int>(x);
  }
  return written;
}

}  // namespace

MaskTap mask_tap(const LinearTap& tap) {
  MaskTap made{.first = tap.first, .weights = {1.0F - tap.weight_of_second, 0.0F, 0.0F}};
  made.weights.at(static_cast<std::size_t>(tap.second - tap.first)) += tap.weight_of_second;
  return made;
}

cv::Rect MaskSampling::pixels_touching(const cv::Rect& samples) const {
  const auto [left, right] = touching(columns, samples.x, samples.br().x - 1);
  const auto [top, bottom] = touching(rows, samples.y, samples.br().y - 1);
  return {pixels.x + left, pixels.y + top, right - left, bottom - top};
}

MaskSampling sample_whole_frame(const Letterbox& letterbox, int step, cv::Size mask_size) {
  const cv::Size frame = letterbox.frame_size;
  const cv::Rect& image = letterbox.image;
  return {.pixels = {cv::Point(0, 0), frame},
          .columns = taps_of_axis(frame.width, image.x, image.width, step, mask_size.width),
          .rows = taps_of_axis(frame.height, image.y, image.height, step, mask_size.height)};
}

cv::Rect paint_mask(const MaskPart& mask,
                    const MaskSampling& sampling,
                    const cv::Rect& pixels,
                    std::uint8_t label,
                    cv::Mat& labels) {
  // Two more, of weight 0, for taps at the right edge; the samples left of the part are not there.
  std::vector<float> blended(static_cast<std::size_t>(mask.values.cols) + 2, 0.0F);
  std::vector<MaskTap> columns(sampling.columns.begin() + (pixels.x - sampling.pixels.x),
                               sampling.columns.begin() + (pixels.br().x - sampling.pixels.x));
  for (MaskTap& column : columns) column.first -= mask.origin.x;
  cv::Rect painted;
  for (int y = pixels.y; y < pixels.br().y; ++y) {
    blend_rows(mask, sampling.rows[static_cast<std::size_t>(y - sampling.pixels.y)], blended);
    const auto [first, last] =
        paint_row(blended, columns, label, labels.ptr<std::uint8_t>(y) + pixels.x);
    if (last >= first) painted |= cv::Rect(pixels.x + first, y, last - first + 1, 1);
  }
  return painted;
}

cv::Rect paint_mask(const cv::Mat_<float>& mask,
                    const MaskSampling& sampling,
                    std::uint8_t label,
                    cv::Mat& labels) {
  constexpr int kReach = 2;  // a tap that takes a sample above one half takes none farther away
  const cv::Rect inside = cv::boundingRect(mask > 0.5F);
  if (inside.empty()) return {};
  const cv::Rect part = cv::Rect(inside.x - kReach, inside.y - kReach, inside.width + 2 * kReach,
                                 inside.height + 2 * kReach) &
                        cv::Rect(cv::Point(0, 0), mask.size());
  return paint_mask({mask(part), part.tl()}, sampling, sampling.pixels_touching(inside), label,
                    labels);
}

}  // namespace tsg
