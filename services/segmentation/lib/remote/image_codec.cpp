#include "services/segmentation/lib/remote/image_codec.hpp"

#include <turbojpeg.h>

#include <memory>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <string>

namespace tsg {

namespace {

tl::unexpected<Error> damaged(const std::string& what) {
  return make_error(ExitCode::kBadData, what +
                                            "; both hosts must run the same version of "
                                            "tsg-segmentation");
}

Expected<ImageBytes> encode(const char* extension,
                            const cv::Mat& image,
                            const std::vector<int>& parameters) {
  ImageBytes bytes;
  try {
    if (cv::imencode(extension, image, bytes, parameters)) return bytes;
  } catch (const cv::Exception& failure) {
    return make_error(ExitCode::kFailure,
                      std::string("cannot compress an image: ") + failure.what());
  }
  return make_error(ExitCode::kFailure, std::string("cannot compress an image as ") + extension);
}

/// Empty where `bytes` are no image.
cv::Mat decode(std::span<const std::uint8_t> bytes, int flags) {
  if (bytes.empty()) return {};
  // NOLINTNEXTLINE(*-const-cast): imdecode() only reads
  const cv::Mat view(1, static_cast<int>(bytes.size()), CV_8UC1,
                     const_cast<std::uint8_t*>(bytes.data()));
  try {
    return cv::imdecode(view, flags);
  } catch (const cv::Exception&) {  // a header of impossible size
    return {};
  }
}

/// The size that the header of a PNG file tells: a few bytes may otherwise unfold into gigabytes.
cv::Size size_in_header(std::span<const std::uint8_t> png) {
  constexpr std::size_t kSizeAt = 16;  // RFC 2083: signature, length and type of IHDR
  if (png.size() < kSizeAt + 8) return {};
  const auto number = [&](std::size_t at) {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < 4; ++i) value = (value << 8U) | png[at + i];
    return static_cast<int>(value);
  };
  return {number(kSizeAt), number(kSizeAt + 4)};
}

}  // namespace

Expected<ImageBytes> encode_colour(const cv::Mat& bgr, int quality) {
  return encode(".jpg", bgr, {cv::IMWRITE_JPEG_QUALITY, quality});
}

Expected<cv::Mat> decode_colour(std::span<const std::uint8_t> jpeg, cv::Size size) {
  const std::unique_ptr<void, decltype(&tjDestroy)> decoder(tjInitDecompress(), &tjDestroy);
  cv::Size found;
  int subsampling = 0;
  int colour_space = 0;
  // The header first: an image is not unfolded before it is known to be no larger than it says.
  const bool has_header = tjDecompressHeader3(decoder.get(), jpeg.data(), jpeg.size(), &found.width,
                                              &found.height, &subsampling, &colour_space) == 0;
  if (has_header && found == size) {
    cv::Mat bgr(size, CV_8UC3);
    if (tjDecompress2(decoder.get(), jpeg.data(), jpeg.size(), bgr.data, size.width,
                      static_cast<int>(bgr.step), size.height, TJPF_BGR, 0) == 0) {
      return bgr;
    }
  }
  return damaged("a colour image came that is damaged or not of the size that it says");
}

Expected<ImageBytes> encode_labels(const cv::Mat& labels) {
  // The least effort: more of it takes three times as long and saves a fifth.
  return encode(".png", labels, {cv::IMWRITE_PNG_COMPRESSION, 1});
}

Expected<void> decode_labels(std::span<const std::uint8_t> png, std::size_t most, cv::Mat& labels) {
  const cv::Mat decoded =
      size_in_header(png) == labels.size() ? decode(png, cv::IMREAD_UNCHANGED) : cv::Mat();
  if (decoded.size() != labels.size() || decoded.type() != CV_8UC1) {
    return damaged("a label image came that is damaged or not of the size that it says");
  }
  double largest = 0.0;
  cv::minMaxLoc(decoded, nullptr, &largest);
  if (largest > static_cast<double>(most)) {
    return damaged("a label image came with label " + std::to_string(static_cast<int>(largest)) +
                   " and " + std::to_string(most) + " instances");
  }
  decoded.copyTo(labels);
  return {};
}

}  // namespace tsg
