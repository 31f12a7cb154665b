#include "common/dataset/image_file.hpp"

#include <turbojpeg.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <memory>
#include <opencv2/imgcodecs.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "common/dataset/text_file.hpp"

namespace tsg {
namespace {

constexpr std::array<std::uint8_t, 8> kPngSignature{0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
constexpr std::array<std::uint8_t, 2> kJpegSignature{0xff, 0xd8};

bool starts_with(std::span<const std::uint8_t> bytes, std::span<const std::uint8_t> signature) {
  return bytes.size() >= signature.size() &&
         std::equal(signature.begin(), signature.end(), bytes.begin());
}

std::uint32_t big_endian(std::span<const std::uint8_t> bytes) {
  return std::uint32_t{bytes[0]} << 24U | std::uint32_t{bytes[1]} << 16U |
         std::uint32_t{bytes[2]} << 8U | std::uint32_t{bytes[3]};
}

/// A chunk of a PNG: length, type, data, checksum over type and data.
struct PngChunk {
  std::string_view type;
  std::span<const std::uint8_t> data;
  bool checksum_is_right = false;
  std::size_t total_bytes = 0;
};

/// The chunk that `bytes` start with; nothing where they end before it does.
std::optional<PngChunk> first_chunk(std::span<const std::uint8_t> bytes) {
  constexpr std::size_t kOverhead = 12;
  if (bytes.size() < kOverhead) return std::nullopt;
  const std::size_t length = big_endian(bytes);
  if (length > bytes.size() - kOverhead) return std::nullopt;
  const auto type_and_data = bytes.subspan(4, 4 + length);
  PngChunk chunk;
  chunk.type = {reinterpret_cast<const char*>(type_and_data.data()), 4};
  chunk.data = type_and_data.subspan(4);
  chunk.checksum_is_right = crc32_z(0, type_and_data.data(), type_and_data.size()) ==
                            big_endian(bytes.subspan(8 + length));
  chunk.total_bytes = kOverhead + length;
  return chunk;
}

struct DestroyDecompressor {
  void operator()(void* handle) const { tjDestroy(handle); }
};
using JpegDecompressor = std::unique_ptr<void, DestroyDecompressor>;

}  // namespace

std::string text_of(const cv::Size& size) {
  return std::to_string(size.width) + "x" + std::to_string(size.height);
}

ImageFile::ImageFile(std::filesystem::path path, std::vector<std::uint8_t> bytes)
    : path_(std::move(path)), bytes_(std::move(bytes)) {}

tl::unexpected<Error> ImageFile::damaged(const std::string& what) const {
  return make_error(
      ExitCode::kBadData,
      path_.string() + " " + what + "; copy the file again or remove its line from the list");
}

Expected<ImageFile> ImageFile::load(const std::filesystem::path& path) {
  const auto text = read_text_file(path, "copy the image there or remove its line from the list");
  if (!text) return tl::unexpected(text.error());
  ImageFile file(path, std::vector<std::uint8_t>(text->begin(), text->end()));
  if (file.bytes_.empty()) return file.damaged("is empty");
  Expected<void> checked;
  if (starts_with(file.bytes_, kPngSignature)) {
    checked = file.check_png();
  } else if (starts_with(file.bytes_, kJpegSignature)) {
    checked = file.check_jpeg();
  } else {
    return file.damaged("is neither a PNG nor a JPEG image");
  }
  if (!checked) return tl::unexpected(checked.error());
  if (file.size_.empty()) return file.damaged("is an image of size " + text_of(file.size_));
  return file;
}

Expected<void> ImageFile::check_png() {
  format_ = Format::kPng;
  std::span<const std::uint8_t> rest = std::span(bytes_).subspan(kPngSignature.size());
  while (const auto chunk = first_chunk(rest)) {
    if (!chunk->checksum_is_right) return damaged("is damaged: a PNG checksum is wrong");
    if (chunk->type == "IHDR" && chunk->data.size() >= 8) {
      size_ = {static_cast<int>(big_endian(chunk->data)),
               static_cast<int>(big_endian(chunk->data.subspan(4)))};
    }
    if (chunk->type == "IEND") return {};
    rest = rest.subspan(chunk->total_bytes);
  }
  return damaged("is truncated: its PNG data ends early");
}

Expected<void> ImageFile::check_jpeg() {
  format_ = Format::kJpeg;
  const JpegDecompressor decompressor(tjInitDecompress());
  int subsampling = 0;
  int colour_space = 0;
  const int result = tjDecompressHeader3(decompressor.get(), bytes_.data(), bytes_.size(),
                                         &size_.width, &size_.height, &subsampling, &colour_space);
  if (result == 0) return {};
  return damaged(std::string("is damaged: ") + tjGetErrorStr2(decompressor.get()));
}

Expected<void> ImageFile::check_view(const cv::Mat& view) const {
  if (view.size() == size_) return {};
  return make_error(ExitCode::kSizeMismatch, path_.string() + " is " + text_of(size_) +
                                                 ", expected were " + text_of(view.size()) +
                                                 "; correct camera.yaml or the image");
}

Expected<void> ImageFile::decode_png(const cv::Mat& view, int imread_flags) const {
  if (auto fits = check_view(view); !fits) return fits;
  cv::Mat decoded = view;
  try {
    cv::imdecode(bytes_, imread_flags, &decoded);
  } catch (const cv::Exception& error) {
    return damaged(std::string("cannot be decoded: ") + error.what());
  }
  if (decoded.empty()) return damaged("cannot be decoded");
  // A file of another type is decoded into memory of its own instead of the caller's.
  if (decoded.data != view.data) return damaged("has another number of channels or bits than due");
  return {};
}

Expected<void> ImageFile::decode_jpeg(const cv::Mat& bgr) const {
  if (auto fits = check_view(bgr); !fits) return fits;
  const JpegDecompressor decompressor(tjInitDecompress());
  const int result = tjDecompress2(decompressor.get(), bytes_.data(), bytes_.size(), bgr.data,
                                   bgr.cols, static_cast<int>(bgr.step[0]), bgr.rows, TJPF_BGR, 0);
  if (result == 0) return {};
  return damaged(std::string("is damaged: ") + tjGetErrorStr2(decompressor.get()));
}

Expected<void> ImageFile::decode_colour(const cv::Mat& bgr) const {
  if (format_ == Format::kJpeg) return decode_jpeg(bgr);
  return decode_png(bgr, cv::IMREAD_COLOR | cv::IMREAD_IGNORE_ORIENTATION);
}

Expected<void> ImageFile::decode_depth(const cv::Mat& depth) const {
  if (format_ != Format::kPng) return damaged("is a JPEG image, but depth must be a 16-bit PNG");
  return decode_png(depth, cv::IMREAD_UNCHANGED);
}

Expected<cv::Mat> ImageFile::decode_ids() const {
  if (format_ != Format::kPng) return damaged("is a JPEG image, but masks must be PNG");
  cv::Mat ids(size_, CV_8UC1);
  if (decode_png(ids, cv::IMREAD_UNCHANGED)) {
    ids.convertTo(ids, CV_16U);
    return ids;
  }
  ids.create(size_, CV_16UC1);
  return decode_png(ids, cv::IMREAD_UNCHANGED).map([&] { return ids; });
}

}  // namespace tsg
