#pragma once

#include <cstdint>
#include <filesystem>
#include <opencv2/core/mat.hpp>
#include <opencv2/core/types.hpp>
#include <vector>

#include "common/core/error.hpp"

namespace tsg {

/// A PNG or JPEG file in memory that has been found whole, so that damage is an error and not a
/// picture with grey bars, which is what decoders make of it.
class ImageFile {
 public:
  /// kMissingInput where the file is absent, kBadData where it is empty, truncated, damaged or
  /// neither PNG nor JPEG; messages name the file. Damage inside JPEG data shows at decoding only.
  [[nodiscard]] static Expected<ImageFile> load(const std::filesystem::path& path);

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  [[nodiscard]] cv::Size size() const { return size_; }  ///< pixels

  /// Decodes into memory of the caller: `bgr` is CV_8UC3 of size(); kSizeMismatch if not, kBadData
  /// for damage. No orientation tag is obeyed: pixels stay where the sensor put them.
  [[nodiscard]] Expected<void> decode_colour(const cv::Mat& bgr) const;
  /// The same for `depth`, CV_16UC1; kBadData unless the file is a PNG of one 16-bit channel.
  [[nodiscard]] Expected<void> decode_depth(const cv::Mat& depth) const;
  /// Instance ids of a mask: CV_16UC1 from a PNG of one channel with 8 or 16 bits.
  [[nodiscard]] Expected<cv::Mat> decode_ids() const;

 private:
  enum class Format { kPng, kJpeg };
  ImageFile(std::filesystem::path path, std::vector<std::uint8_t> bytes);

  [[nodiscard]] Expected<void> check_png();
  [[nodiscard]] Expected<void> check_jpeg();
  [[nodiscard]] Expected<void> check_view(const cv::Mat& view) const;
  [[nodiscard]] Expected<void> decode_png(const cv::Mat& view, int imread_flags) const;
  [[nodiscard]] Expected<void> decode_jpeg(const cv::Mat& bgr) const;
  [[nodiscard]] tl::unexpected<Error> damaged(const std::string& what) const;

  std::filesystem::path path_;
  std::vector<std::uint8_t> bytes_;
  Format format_ = Format::kPng;
  cv::Size size_;
};

/// "640x480": how messages write sizes.
[[nodiscard]] std::string text_of(const cv::Size& size);

}  // namespace tsg
