#include "services/slam/lib/feature_extractor.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

#include "services/slam/lib/depth_sampler.hpp"
#include "services/slam/lib/oriented_brief.hpp"

namespace tsg {
namespace {

constexpr int kMargin = kPatchRadius + 1;

/// Features per level in proportion to the level's side length, `total` in sum.
std::vector<int> share_out(int total, const std::vector<double>& scales) {
  double sum = 0.0;
  for (const double scale : scales) sum += 1.0 / scale;
  std::vector<int> budgets;
  int left = total;
  for (std::size_t level = 0; level + 1 < scales.size(); ++level) {
    budgets.push_back(static_cast<int>(std::lround(total / scales[level] / sum)));
    left -= budgets.back();
  }
  budgets.push_back(std::max(0, left));
  return budgets;
}

/// Centres of pixels are at integers, so a level's pixel (0, 0) lies right below that of level 0.
Eigen::Vector2f to_level_0(const cv::Point2f& point, const Eigen::Vector2d& scale) {
  return {static_cast<float>((point.x + 0.5) * scale.x() - 0.5),
          static_cast<float>((point.y + 0.5) * scale.y() - 0.5)};
}

FeatureVerdict verdict_at(const cv::Mat& verdicts, const cv::Point& pixel) {
  return verdicts.empty() ? FeatureVerdict::kStatic
                          : static_cast<FeatureVerdict>(verdicts.at<std::uint8_t>(pixel));
}

}  // namespace

FeatureExtractor::FeatureExtractor(const FeatureConfig& config, const CameraModel& camera)
    : config_(config),
      camera_(camera),
      detector_(config.fast_threshold, config.min_fast_threshold),
      pyramid_(static_cast<std::size_t>(config.levels)) {
  for (int level = 0; level < config.levels; ++level) {
    scales_.push_back(std::pow(config.scale_factor, level));
  }
  budgets_ = share_out(config.max_features, scales_);
}

Features FeatureExtractor::extract(const RgbdFrame& frame,
                                   const cv::Mat& verdicts,
                                   DynamicPixels dynamic_pixels) {
  dynamic_pixels_ = dynamic_pixels;
  Features features;
  features.seq = frame.seq;
  features.stamp_ns = frame.stamp_ns;
  features.items.reserve(static_cast<std::size_t>(config_.max_features));
  features.descriptors.reserve(static_cast<std::size_t>(config_.max_features));
  left_out_.clear();
  build_pyramid(frame.colour);
  for (std::size_t level = 0; level < pyramid_.size(); ++level) {
    extract_level(level, verdicts, features);
  }
  for (Feature& feature : features.items) {
    feature.inverse_depth = sample_inverse_depth(frame.depth, frame.depth_units_per_metre,
                                                 {feature.raw_x, feature.raw_y}, config_);
    if (feature.has_depth()) ++features.counts.with_depth;
    if (feature.verdict == FeatureVerdict::kPotentiallyDynamic) {
      ++features.counts.potentially_dynamic;
    }
  }
  features.surface = sample_surface(frame, verdicts, config_);
  undistort(features);
  features.grid = FeatureGrid(features.items, camera_.width, camera_.height);
  return features;
}

void FeatureExtractor::build_pyramid(const cv::Mat& colour) {
  cv::cvtColor(colour, pyramid_[0], cv::COLOR_BGR2GRAY);
  for (std::size_t level = 1; level < pyramid_.size(); ++level) {
    const cv::Size size(cvRound(camera_.width / scales_[level]),
                        cvRound(camera_.height / scales_[level]));
    cv::resize(pyramid_[level - 1], pyramid_[level], size, 0.0, 0.0, cv::INTER_LINEAR);
  }
}

void FeatureExtractor::extract_level(std::size_t level,
                                     const cv::Mat& verdicts,
                                     Features& features) {
  const cv::Mat& image = pyramid_[level];
  const Eigen::Vector2d scale(static_cast<double>(camera_.width) / image.cols,
                              static_cast<double>(camera_.height) / image.rows);
  const bool leaves_out = dynamic_pixels_ == DynamicPixels::kLeaveOut && !verdicts.empty();
  corners_.clear();
  dynamic_corners_.clear();
  for (const cv::KeyPoint& corner : detector_.detect(image, kMargin)) {
    const bool dynamic =
        leaves_out &&
        verdict_at(verdicts, raw_pixel(to_level_0(corner.pt, scale))) == FeatureVerdict::kDynamic;
    (dynamic ? dynamic_corners_ : corners_).push_back(corner);
  }
  features.counts.dynamic += static_cast<int>(dynamic_corners_.size());
  keep_spread(corners_, image.size(), budgets_[level]);
  keep_spread(dynamic_corners_, image.size(), budgets_[level]);
  for (const cv::KeyPoint& corner : dynamic_corners_) {
    left_out_.push_back(raw_pixel(to_level_0(corner.pt, scale)));
  }
  blur_.blur(image, blurred_);
  for (const cv::KeyPoint& corner : corners_) {
    const int x = static_cast<int>(corner.pt.x);
    const int y = static_cast<int>(corner.pt.y);
    Feature feature;
    feature.pixel = to_level_0(corner.pt, scale);
    const cv::Point raw = raw_pixel(feature.pixel);
    feature.raw_x = static_cast<std::int16_t>(raw.x);
    feature.raw_y = static_cast<std::int16_t>(raw.y);
    feature.level = static_cast<std::uint8_t>(level);
    feature.verdict = verdict_at(verdicts, raw);
    feature.angle = intensity_direction(image, x, y);
    features.items.push_back(feature);
    features.descriptors.push_back(oriented_brief(blurred_, x, y, feature.angle));
  }
}

cv::Point FeatureExtractor::raw_pixel(const Eigen::Vector2f& pixel) const {
  return {std::clamp(cvRound(pixel.x()), 0, camera_.width - 1),
          std::clamp(cvRound(pixel.y()), 0, camera_.height - 1)};
}

void FeatureExtractor::undistort(Features& features) const {
  if (!camera_.is_distorted() || features.items.empty()) return;
  std::vector<cv::Point2f> pixels;
  pixels.reserve(features.size());
  for (const Feature& feature : features.items) {
    pixels.emplace_back(feature.pixel.x(), feature.pixel.y());
  }
  const cv::Matx33d K(camera_.fx, 0, camera_.cx, 0, camera_.fy, camera_.cy, 0, 0, 1);
  const cv::TermCriteria until(cv::TermCriteria::COUNT | cv::TermCriteria::EPS, 20, 1e-3);
  cv::undistortPoints(pixels, pixels, K, camera_.distortion, cv::noArray(), K, until);
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    features.items[i].pixel = {pixels[i].x, pixels[i].y};
  }
}

}  // namespace tsg
