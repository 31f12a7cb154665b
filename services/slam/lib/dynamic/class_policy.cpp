#include "services/slam/lib/dynamic/class_policy.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <string>

namespace tsg {
namespace {

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

}  // namespace

VerdictOfLabel verdict_of_labels(const InstanceSegmentation& mask,
                                 const DynamicFilterConfig& config) {
  VerdictOfLabel verdicts{};  // all static
  const std::size_t count = std::min(mask.instances.size(), verdicts.size() - 1);
  for (std::size_t i = 0; i < count; ++i) {
    const Instance& instance = mask.instances[i];
    if (instance.score < config.min_score) continue;
    if (contains(config.dynamic_classes, instance.class_name)) {
      verdicts[i + 1] = FeatureVerdict::kDynamic;
    } else if (contains(config.potentially_dynamic_classes, instance.class_name)) {
      verdicts[i + 1] = FeatureVerdict::kPotentiallyDynamic;
    }
  }
  return verdicts;
}

cv::Mat verdicts_of_pixels(const InstanceSegmentation& mask, const DynamicFilterConfig& config) {
  cv::Mat verdicts = cv::Mat::zeros(mask.labels.size(), CV_8UC1);
  raise_verdicts(mask, config, verdicts);
  return verdicts;
}

void raise_verdicts(const InstanceSegmentation& mask,
                    const DynamicFilterConfig& config,
                    cv::Mat& verdicts) {
  const VerdictOfLabel verdict_of = verdict_of_labels(mask, config);
  for (int y = 0; y < verdicts.rows; ++y) {
    const auto* label = mask.labels.ptr<std::uint8_t>(y);
    auto* verdict = verdicts.ptr<std::uint8_t>(y);
    for (int x = 0; x < verdicts.cols;) {
      std::uint64_t eight = 1;
      if (x + 8 <= verdicts.cols) std::memcpy(&eight, label + x, sizeof eight);
      const int end = std::min(x + 8, verdicts.cols);
      if (eight == 0) x = end;  // background, as most of an image is
      for (; x < end; ++x) {
        verdict[x] = std::max(verdict[x], static_cast<std::uint8_t>(verdict_of[label[x]]));
      }
    }
  }
}

cv::Mat exact_verdicts(const InstanceSegmentation& mask, const DynamicFilterConfig& config) {
  cv::Mat verdicts = verdicts_of_pixels(mask, config);
  dilate_dynamic(verdicts, static_cast<int>(std::lround(config.dilation_px)));
  return verdicts;
}

void dilate_dynamic(cv::Mat& verdicts, int radius_px) {
  if (radius_px <= 0) return;
  // kDynamic is the largest verdict, but kPotentiallyDynamic must not grow with it.
  const auto dynamic = static_cast<double>(FeatureVerdict::kDynamic);
  cv::Mat grown = verdicts == dynamic;
  const int side = 2 * radius_px + 1;
  cv::dilate(grown, grown, cv::getStructuringElement(cv::MORPH_RECT, {side, side}));
  verdicts.setTo(dynamic, grown);
}

}  // namespace tsg
