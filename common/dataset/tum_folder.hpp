#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "common/core/error.hpp"
#include "common/dataset/association.hpp"
#include "common/dataset/camera_file.hpp"
#include "common/rgbd/rgbd_frame.hpp"

namespace tsg {

/// A line of rgb.txt or depth.txt.
struct ListedImage {
  std::int64_t stamp_ns = 0;
  std::filesystem::path path;
};

/// A colour image and the depth image that belongs to it.
struct RgbdFiles {
  std::int64_t stamp_ns = 0;  ///< of the colour image
  std::filesystem::path colour;
  std::filesystem::path depth;
};

/// A recorded sequence in the layout of the TUM RGB-D benchmark.
struct TumFolder {
  std::filesystem::path path;
  RecordedCamera camera;
  std::vector<RgbdFiles> frames;  ///< by time; at least one
};

/// Reads "stamp file" lines, sorted by time; of lines with one stamp the first counts. Files are
/// relative to the list. Errors: kMissingInput, kEmptyInput, kBadData with file and line.
[[nodiscard]] Expected<std::vector<ListedImage>> read_image_list(const std::filesystem::path& list);

/// Reads camera.yaml, rgb.txt and depth.txt and pairs the images (associate()); no image is opened.
/// Folders named as in the TUM benchmark need no camera.yaml (tum_benchmark_camera()).
/// kMissingInput names the folder, list or image that is not there, kEmptyInput a list without
/// entries or lists without a pair.
[[nodiscard]] Expected<TumFolder> open_tum_folder(
    const std::filesystem::path& path, std::int64_t max_difference_ns = kDefaultMaxDifferenceNs);

/// Decodes both images of a frame into memory of the caller: `colour` CV_8UC3, `depth` CV_16UC1,
/// both of the camera's size. kSizeMismatch, naming files and sizes, where an image has another.
[[nodiscard]] Expected<void> decode_frame(const RgbdFiles& files,
                                          const cv::Mat& colour,
                                          const cv::Mat& depth);

/// A frame with memory of its own; `seq` is its index.
[[nodiscard]] Expected<RgbdFrame> read_frame(const TumFolder& folder, std::size_t index);

}  // namespace tsg
