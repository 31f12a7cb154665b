#include "services/tsgctl/model/model_run.hpp"

#include <algorithm>
#include <array>
#include <memory>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <string>

#include "common/core/atomic_file.hpp"
#include "common/core/time.hpp"
#include "common/dataset/image_file.hpp"
#include "services/tsgctl/lib/text_format.hpp"

namespace tsg {

namespace {

namespace fs = std::filesystem;

constexpr int kSmallWidth = 640;  // pixels; below it names would cover what they name

bool is_image(const fs::path& path) {
  const std::string extension = path.extension();
  return extension == ".png" || extension == ".jpg" || extension == ".jpeg";
}

/// Colours that neighbours in the list do not share, BGR.
cv::Scalar colour_of(std::size_t instance) {
  constexpr std::array<std::array<int, 3>, 8> kColours = {{{60, 60, 230},
                                                           {230, 160, 40},
                                                           {60, 200, 60},
                                                           {40, 200, 240},
                                                           {220, 60, 200},
                                                           {200, 220, 60},
                                                           {30, 130, 250},
                                                           {180, 120, 120}}};
  const auto& bgr = kColours.at(instance % kColours.size());
  return {double(bgr[0]), double(bgr[1]), double(bgr[2])};
}

Expected<cv::Mat> read_colour(const fs::path& path) {
  auto file = ImageFile::load(path);
  if (!file) return tl::unexpected(file.error());
  cv::Mat bgr(file->size(), CV_8UC3);
  if (auto decoded = file->decode_colour(bgr); !decoded) return tl::unexpected(decoded.error());
  return bgr;
}

Expected<void> write_png(const fs::path& path, const cv::Mat& image) {
  std::vector<std::uint8_t> bytes;
  cv::imencode(".png", image, bytes);
  return write_file_atomically(path, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

nlohmann::json to_json(const Instance& instance) {
  const cv::Rect2f& box = instance.box;
  return {{"class", instance.class_name},
          {"score", instance.score},
          {"box", {box.x, box.y, box.width, box.height}}};
}

nlohmann::json to_json(const fs::path& image, const SegmentationResult& result) {
  nlohmann::json instances = nlohmann::json::array();
  for (const Instance& each : result.segmentation.instances) instances.push_back(to_json(each));
  return {{"image", image.filename().string()},
          {"preprocess_ms", to_milliseconds(result.times.preprocess_ns)},
          {"network_ms", to_milliseconds(result.times.network_ns)},
          {"postprocess_ms", to_milliseconds(result.times.postprocess_ns)},
          {"instances", instances}};
}

/// Segments one image and writes all but the summary, which is the answer.
Expected<nlohmann::json> run_on(const fs::path& image, const ModelRun& run, ModelProvider& model) {
  const auto bgr = read_colour(image);
  if (!bgr) return tl::unexpected(bgr.error());
  const RgbdFrame frame{.seq = 0, .stamp_ns = 0, .camera = {}, .colour = *bgr, .depth = {}};
  cv::Mat labels;
  const auto result = model.segment(frame, labels);
  if (!result) {
    return make_error(result.error().code, image.string() + ": " + result.error().message);
  }
  const fs::path name = image.stem().string() + ".png";
  auto written = write_png(run.out / "mask" / name, result->segmentation.labels);
  if (written && run.pictures) {
    written = write_png(run.out / "picture" / name, draw_instances(*bgr, result->segmentation));
  }
  if (!written) return tl::unexpected(written.error());
  return to_json(image, *result);
}

}  // namespace

Expected<std::vector<fs::path>> colour_images(const fs::path& folder) {
  std::error_code error;
  if (!fs::is_directory(folder, error)) {
    return make_error(ExitCode::kMissingInput,
                      folder.string() + ": no such folder; give one with images, or a sequence");
  }
  const fs::path where = fs::is_directory(folder / "rgb", error) ? folder / "rgb" : folder;
  std::vector<fs::path> images;
  for (const auto& entry : fs::directory_iterator(where, error)) {
    if (is_image(entry.path())) images.push_back(entry.path());
  }
  if (images.empty()) {
    return make_error(ExitCode::kEmptyInput,
                      where.string() + ": there is no PNG or JPEG image in it; give another");
  }
  std::ranges::sort(images);
  return images;
}

cv::Mat draw_instances(const cv::Mat& bgr, const InstanceSegmentation& found) {
  const double scale = bgr.cols < kSmallWidth ? 2.0 : 1.0;
  cv::Mat picture;
  cv::Mat labels;
  cv::resize(bgr, picture, {}, scale, scale, cv::INTER_LINEAR);
  cv::resize(found.labels, labels, picture.size(), 0.0, 0.0, cv::INTER_NEAREST);
  const cv::Mat plain = picture.clone();
  for (std::size_t i = 0; i < found.instances.size(); ++i) {
    picture.setTo(colour_of(i), labels == static_cast<int>(i) + 1);
  }
  cv::addWeighted(picture, 0.45, plain, 0.55, 0.0, picture);
  for (std::size_t i = 0; i < found.instances.size(); ++i) {
    const Instance& instance = found.instances[i];
    const cv::Rect2f& box = instance.box;
    const cv::Point middle(cvRound(scale * (box.x + 0.5F * box.width)),
                           cvRound(scale * (box.y + 0.5F * box.height)));
    const std::string text = instance.class_name + " " + fixed(instance.score, 2);
    const cv::Point corner(std::max(0, middle.x - 4 * static_cast<int>(text.size())), middle.y);
    cv::putText(picture, text, corner, cv::FONT_HERSHEY_SIMPLEX, 0.45, {0, 0, 0}, 3, cv::LINE_AA);
    cv::putText(picture, text, corner, cv::FONT_HERSHEY_SIMPLEX, 0.45, {255, 255, 255}, 1,
                cv::LINE_AA);
  }
  return picture;
}

Expected<void> run_model(const ModelRun& run, const std::function<void(int, int)>& on_image) {
  const auto images = colour_images(run.input);
  if (!images) return tl::unexpected(images.error());
  const auto model = ModelProvider::make(run.provider);
  if (!model) return tl::unexpected(model.error());
  for (const char* folder : {"mask", "picture"}) {
    if (folder == std::string("picture") && !run.pictures) continue;
    if (auto made = make_folder(run.out / folder); !made) return made;
  }
  nlohmann::json summary = {{"model", run.provider.model.file},
                            {"input", run.input.string()},
                            {"images", nlohmann::json::array()}};
  for (const fs::path& image : *images) {
    auto found = run_on(image, run, **model);
    if (!found) return tl::unexpected(found.error());
    summary["images"].push_back(std::move(*found));
    on_image(static_cast<int>(summary["images"].size()), static_cast<int>(images->size()));
  }
  return write_file_atomically(run.out / "found.json", summary.dump(1) + "\n");
}

}  // namespace tsg
