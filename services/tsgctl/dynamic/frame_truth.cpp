#include "services/tsgctl/dynamic/frame_truth.hpp"

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

namespace tsg {
namespace {

TrueState state_of(MotionVerdict motion, FeatureVerdict prior) {
  if (motion == MotionVerdict::kUnknown) return TrueState::kUnknown;
  if (motion == MotionVerdict::kMoving) return TrueState::kMoving;
  return prior == FeatureVerdict::kDynamic ? TrueState::kResting : TrueState::kStill;
}

cv::Mat find_edges(const FrameTruth& truth, int margin_px) {
  if (margin_px <= 0) return cv::Mat::zeros(truth.labels.size(), CV_8UC1);
  cv::Mat table = cv::Mat::zeros(1, 256, CV_8UC1);
  for (std::size_t i = 0; i < truth.instances.size(); ++i) {
    table.at<std::uint8_t>(static_cast<int>(i) + 1) =
        static_cast<std::uint8_t>(truth.instances[i].state);
  }
  cv::Mat states;
  cv::LUT(truth.labels, table, states);
  const int side = 2 * margin_px + 1;
  const cv::Mat window = cv::getStructuringElement(cv::MORPH_RECT, {side, side});
  cv::Mat highest;
  cv::Mat lowest;
  cv::dilate(states, highest, window);
  cv::erode(states, lowest, window);
  return highest != lowest;
}

}  // namespace

FrameTruth make_frame_truth(const TrueMask& mask,
                            const std::map<int, KnownInstance>& known,
                            const DynamicFilterConfig& config,
                            int margin_px) {
  FrameTruth truth{.labels = mask.segmentation.labels, .at_edge = {}, .instances = {}};
  const VerdictOfLabel prior_of = verdict_of_labels(mask.segmentation, config);
  for (std::size_t i = 0; i < mask.ids.size(); ++i) {
    const Instance& instance = mask.segmentation.instances[i];
    const FeatureVerdict prior = prior_of[i + 1];
    truth.instances.push_back({.id = mask.ids[i],
                               .class_name = instance.class_name,
                               .name = known.at(mask.ids[i]).name,
                               .prior = prior,
                               .state = state_of(instance.motion, prior)});
  }
  truth.at_edge = find_edges(truth, margin_px);
  return truth;
}

}  // namespace tsg
