#include "common/dataset/tum_folder.hpp"

#include <algorithm>
#include <string>
#include <system_error>

#include "common/dataset/image_file.hpp"
#include "common/dataset/stamp.hpp"
#include "common/dataset/text_file.hpp"
#include "common/dataset/tum_cameras.hpp"

namespace tsg {
namespace {

namespace fs = std::filesystem;

std::vector<std::int64_t> stamps_of(const std::vector<ListedImage>& images) {
  std::vector<std::int64_t> stamps;
  stamps.reserve(images.size());
  for (const ListedImage& image : images) stamps.push_back(image.stamp_ns);
  return stamps;
}

Expected<void> check_present(const fs::path& image, const fs::path& list) {
  std::error_code ignored;
  if (fs::is_regular_file(image, ignored)) return {};
  return make_error(ExitCode::kMissingInput, "there is no image " + image.string() + ", which " +
                                                 list.string() +
                                                 " lists; copy it there or remove the line");
}

Expected<std::vector<RgbdFiles>> pair_images(const fs::path& folder,
                                             const std::vector<ListedImage>& colour,
                                             const std::vector<ListedImage>& depth,
                                             std::int64_t max_difference_ns) {
  std::vector<RgbdFiles> frames;
  for (const StampPair& pair : associate(stamps_of(colour), stamps_of(depth), max_difference_ns)) {
    const ListedImage& colour_image = colour[pair.first];
    const ListedImage& depth_image = depth[pair.second];
    if (auto there = check_present(colour_image.path, folder / "rgb.txt"); !there) {
      return tl::unexpected(there.error());
    }
    if (auto there = check_present(depth_image.path, folder / "depth.txt"); !there) {
      return tl::unexpected(there.error());
    }
    frames.push_back({colour_image.stamp_ns, colour_image.path, depth_image.path});
  }
  if (!frames.empty()) return frames;
  return make_error(ExitCode::kEmptyInput, "no colour image of " + folder.string() +
                                               " has a depth image within " +
                                               std::to_string(max_difference_ns / 1'000'000) +
                                               " ms; check the stamps in rgb.txt and depth.txt");
}

Expected<void> check_same_size(const ImageFile& colour, const ImageFile& depth) {
  if (colour.size() == depth.size()) return {};
  return make_error(ExitCode::kSizeMismatch,
                    colour.path().string() + " is " + text_of(colour.size()) + ", but " +
                        depth.path().string() + " is " + text_of(depth.size()) +
                        "; register depth to colour");
}

Expected<void> check_camera_size(const ImageFile& image, const cv::Size& size) {
  if (image.size() == size) return {};
  const fs::path folder = image.path().parent_path().parent_path();
  return make_error(ExitCode::kSizeMismatch, image.path().string() + " is " +
                                                 text_of(image.size()) + ", but " +
                                                 (folder / "camera.yaml").string() + " says " +
                                                 text_of(size) + "; correct the one that is wrong");
}

/// camera.yaml, which wins; without it the benchmark's calibration where the folder's name is of
/// it.
Expected<RecordedCamera> camera_of(const fs::path& folder) {
  const fs::path file = folder / "camera.yaml";
  std::error_code ignored;
  if (!fs::exists(file, ignored)) {
    // With a last element, even where the path ends with a slash or is ".".
    const fs::path whole = fs::absolute(folder / "x").lexically_normal().parent_path();
    if (const auto known = tum_benchmark_camera(whole.filename().string())) return *known;
  }
  return read_camera_file(file);
}

}  // namespace

Expected<std::vector<ListedImage>> read_image_list(const fs::path& list) {
  const auto lines = read_data_lines(list, "give a folder in TUM layout (rgb.txt, depth.txt)");
  if (!lines) return tl::unexpected(lines.error());
  std::vector<ListedImage> images;
  for (const DataLine& line : *lines) {
    const auto stamp_ns = parse_stamp_ns(line.fields.front());
    if (!stamp_ns || line.fields.size() != 2) {
      return make_error(ExitCode::kBadData,
                        place(list, line.number) +
                            ": a line must be \"stamp file\", the stamp in seconds; correct it");
    }
    images.push_back({*stamp_ns, list.parent_path() / line.fields[1]});
  }
  if (images.empty()) {
    return make_error(ExitCode::kEmptyInput,
                      list.string() + " lists no image; record the sequence again");
  }
  std::stable_sort(images.begin(), images.end(),
                   [](const auto& a, const auto& b) { return a.stamp_ns < b.stamp_ns; });
  const auto same_stamp = [](const auto& a, const auto& b) { return a.stamp_ns == b.stamp_ns; };
  images.erase(std::unique(images.begin(), images.end(), same_stamp), images.end());
  return images;
}

Expected<TumFolder> open_tum_folder(const fs::path& path, std::int64_t max_difference_ns) {
  std::error_code ignored;
  if (!fs::is_directory(path, ignored)) {
    return make_error(ExitCode::kMissingInput,
                      "there is no folder " + path.string() +
                          "; give one in TUM layout (rgb.txt, depth.txt, camera.yaml)");
  }
  const auto colour = read_image_list(path / "rgb.txt");
  if (!colour) return tl::unexpected(colour.error());
  const auto depth = read_image_list(path / "depth.txt");
  if (!depth) return tl::unexpected(depth.error());
  const auto camera = camera_of(path);
  if (!camera) return tl::unexpected(camera.error());
  auto frames = pair_images(path, *colour, *depth, max_difference_ns);
  if (!frames) return tl::unexpected(frames.error());
  return TumFolder{path, *camera, std::move(*frames)};
}

Expected<void> decode_frame(const RgbdFiles& files, const cv::Mat& colour, const cv::Mat& depth) {
  const auto colour_file = ImageFile::load(files.colour);
  if (!colour_file) return tl::unexpected(colour_file.error());
  const auto depth_file = ImageFile::load(files.depth);
  if (!depth_file) return tl::unexpected(depth_file.error());
  return check_same_size(*colour_file, *depth_file)
      .and_then([&] { return check_camera_size(*colour_file, colour.size()); })
      .and_then([&] { return colour_file->decode_colour(colour); })
      .and_then([&] { return depth_file->decode_depth(depth); });
}

Expected<RgbdFrame> read_frame(const TumFolder& folder, std::size_t index) {
  const CameraModel& camera = folder.camera.model;
  const RgbdFiles& files = folder.frames.at(index);
  RgbdFrame frame;
  frame.seq = index;
  frame.stamp_ns = files.stamp_ns;
  frame.camera = camera;
  frame.depth_units_per_metre = folder.camera.depth_units_per_metre;
  frame.colour.create(camera.height, camera.width, CV_8UC3);
  frame.depth.create(camera.height, camera.width, CV_16UC1);
  return decode_frame(files, frame.colour, frame.depth).map([&] { return frame; });
}

}  // namespace tsg
