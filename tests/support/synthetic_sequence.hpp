#pragma once

#include <cstdint>
#include <iomanip>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <sstream>
#include <string>

#include "tests/support/temp_folder.hpp"

namespace tsg::test {

inline constexpr std::int64_t kSequenceStartNs = 1'700'000'000'000'000'000;

/// A small made-up sequence in TUM layout; its images tell their frame and place.
struct SyntheticSequence {
  int frames = 5;
  cv::Size size{64, 48};
  std::int64_t period_ns = 33'333'000;  // whole microseconds, as the lists have them

  [[nodiscard]] std::int64_t stamp_ns(int frame) const {
    return kSequenceStartNs + frame * period_ns;
  }

  /// Every pixel depends on frame, row, column and channel.
  [[nodiscard]] cv::Mat colour(int frame) const {
    cv::Mat image(size, CV_8UC3);
    image.forEach<cv::Vec3b>([frame](cv::Vec3b& pixel, const int* at) {
      for (int channel = 0; channel < 3; ++channel) {
        pixel[channel] =
            cv::saturate_cast<std::uint8_t>((7 * at[0] + 3 * at[1] + 50 * channel + frame) % 256);
      }
    });
    return image;
  }
  [[nodiscard]] cv::Mat depth(int frame) const {
    cv::Mat image(size, CV_16UC1);
    image.forEach<std::uint16_t>([frame](std::uint16_t& pixel, const int* at) {
      pixel = static_cast<std::uint16_t>(5000 + 100 * at[0] + at[1] + frame);
    });
    return image;
  }

  /// rgb/ and depth/ as PNG with their lists, camera.yaml and groundtruth.txt.
  void write_to(const TempFolder& folder) const {
    std::string rgb_list = "# colour images\n";
    std::string depth_list = "# depth images\n";
    std::string poses = "# stamp tx ty tz qx qy qz qw\n";
    std::filesystem::create_directories(folder / "rgb");
    std::filesystem::create_directories(folder / "depth");
    for (int frame = 0; frame < frames; ++frame) {
      const std::string stamp = stamp_text(frame);
      cv::imwrite((folder / "rgb" / (stamp + ".png")).string(), colour(frame));
      cv::imwrite((folder / "depth" / (stamp + ".png")).string(), depth(frame));
      rgb_list += stamp + " rgb/" + stamp + ".png\n";
      depth_list += stamp + " depth/" + stamp + ".png\n";
      poses += stamp + " " + std::to_string(0.01 * frame) + " 0 0 0 0 0 1\n";
    }
    folder.write("rgb.txt", rgb_list);
    folder.write("depth.txt", depth_list);
    folder.write("groundtruth.txt", poses);
    folder.write("camera.yaml", camera_yaml());
  }

  [[nodiscard]] std::string camera_yaml() const {
    return "%YAML:1.0\n---\nfx: 50.0\nfy: 51.0\ncx: 31.5\ncy: 23.5\nk1: 0.1\nk2: 0.2\np1: 0.3\n"
           "p2: 0.4\nk3: 0.5\nwidth: " +
           std::to_string(size.width) + "\nheight: " + std::to_string(size.height) +
           "\nfps: 30.0\ndepth_scale: 5000.0\ndepth_registered: 1\n";
  }

  /// The stamp as lists and file names have it.
  [[nodiscard]] std::string stamp_text(int frame) const {
    std::ostringstream text;
    text << stamp_ns(frame) / 1'000'000'000 << '.' << std::setw(6) << std::setfill('0')
         << stamp_ns(frame) % 1'000'000'000 / 1000;
    return text.str();
  }
};

/// True where two images agree in type, size and every pixel.
inline bool is_same_image(const cv::Mat& a, const cv::Mat& b) {
  return a.type() == b.type() && a.size() == b.size() && cv::norm(a, b, cv::NORM_INF) == 0.0;
}

}  // namespace tsg::test
