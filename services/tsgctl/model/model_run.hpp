#pragma once

#include <filesystem>
#include <functional>
#include <vector>

#include "common/core/error.hpp"
#include "common/rgbd/instances.hpp"
#include "services/segmentation/lib/model_provider.hpp"

namespace tsg {

/// The colour images (PNG, JPEG) of a folder, by name: those in its folder rgb, where it has one.
/// kMissingInput where `folder` is not there, kEmptyInput where it holds none.
[[nodiscard]] Expected<std::vector<std::filesystem::path>> colour_images(
    const std::filesystem::path& folder);

/// The image with its instances tinted and named, twice as large where it is small.
[[nodiscard]] cv::Mat draw_instances(const cv::Mat& bgr, const InstanceSegmentation& found);

/// Where images come from and what is found in them goes.
struct ModelRun {
  ModelProviderConfig provider;
  std::filesystem::path input;
  std::filesystem::path out;  ///< gets mask/, found.json and, if asked for, picture/
  bool pictures = false;
};

/// Runs a network over images as the segmentation service does. out/mask has a label image for each
/// (8 bits, 0 = none, i + 1 = its instance i), out/found.json, written last, the instances with
/// class, score and box, and the times. `on_image` is told how many are done, of how many. Errors
/// are those of colour_images(), of reading and writing files and of ModelProvider.
[[nodiscard]] Expected<void> run_model(const ModelRun& run,
                                       const std::function<void(int, int)>& on_image);

}  // namespace tsg
