#include "services/tsgctl/dynamic/debug_picture.hpp"

#include <algorithm>
#include <array>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

#include "services/tsgctl/lib/text_format.hpp"

namespace tsg {
namespace {

// BGR
const cv::Scalar kGreen(80, 220, 60);
const cv::Scalar kDarkGreen(50, 130, 40);  // so that dots stand out against outlines
const cv::Scalar kRed(50, 50, 255);
const cv::Scalar kAmber(0, 170, 255);
const cv::Scalar kMagenta(255, 60, 255);
const cv::Scalar kWhite(255, 255, 255);
const cv::Scalar kDark(30, 30, 30);

constexpr int kPictureWidth = 1280;  // small images are enlarged to it: circles must not hide them
constexpr int kLegendHeight = 34;
constexpr int kFont = cv::FONT_HERSHEY_SIMPLEX;
constexpr double kFontScale = 0.5;
constexpr double kSameThing = 0.3;  // overlap of a mask's instance and a followed one, box to box

cv::Scalar colour_of(const InstanceState& state) {
  if (state.is_moving) return kRed;
  return state.prior == FeatureVerdict::kStatic ? kDarkGreen : kAmber;
}

cv::Scalar colour_of(FeatureVerdict prior) {
  if (prior == FeatureVerdict::kDynamic) return kRed;
  return prior == FeatureVerdict::kPotentiallyDynamic ? kAmber : kDarkGreen;
}

cv::Scalar colour_of(const JudgedFeature& feature) {
  if (!feature.is_dynamic) return kGreen;
  return feature.prior == FeatureVerdict::kStatic ? kMagenta : kRed;
}

double overlap(const cv::Rect& a, const cv::Rect& b) {
  const double common = (a & b).area();
  const double joined = a.area() + b.area() - common;
  return joined > 0.0 ? common / joined : 0.0;
}

struct Label {
  std::string text;
  cv::Point corner;  ///< upper left
  cv::Scalar colour;
};

class Painter {
 public:
  explicit Painter(const DebugView& view)
      : view_(view), scale_(std::max(1, kPictureWidth / std::max(1, view.colour.cols))) {
    cv::resize(view.colour, image_, {}, scale_, scale_, cv::INTER_LINEAR);
    cv::copyMakeBorder(image_, image_, 0, kLegendHeight, 0, 0, cv::BORDER_CONSTANT, kDark);
  }

  cv::Mat paint() {
    if (view_.mask != nullptr) draw_mask();
    for (const JudgedFeature& feature : view_.verdicts->features) draw(feature);
    for (const InstanceState& state : view_.verdicts->instances) draw(state);
    for (const Label& label : labels_) write(label);
    draw_legend();
    return image_;
  }

 private:
  void draw_mask();
  cv::Point draw_outline(int label, const cv::Scalar& colour);
  [[nodiscard]] const InstanceState* state_of(const Instance& instance) const;
  void draw(const JudgedFeature& feature);
  void draw(const InstanceState& state);
  void draw_legend();
  void write(const Label& label);

  [[nodiscard]] cv::Point enlarged(int x, int y) const {
    return {x * scale_ + scale_ / 2, y * scale_ + scale_ / 2};
  }
  [[nodiscard]] int picture_height() const { return image_.rows - kLegendHeight; }

  const DebugView& view_;
  int scale_;
  cv::Mat image_;
  std::vector<Label> labels_;  ///< on top of all else
};

const InstanceState* Painter::state_of(const Instance& instance) const {
  const InstanceState* best = nullptr;
  double best_overlap = kSameThing;
  for (const InstanceState& state : view_.verdicts->instances) {
    if (state.class_name != instance.class_name) continue;
    const double common = overlap(state.box, cv::Rect(instance.box));
    if (common < best_overlap) continue;
    best_overlap = common;
    best = &state;
  }
  return best;
}

void Painter::draw_mask() {
  const VerdictOfLabel prior_of = verdict_of_labels(*view_.mask, *view_.config);
  for (std::size_t i = 0; i < view_.mask->instances.size(); ++i) {
    const Instance& instance = view_.mask->instances[i];
    const FeatureVerdict prior = prior_of[i + 1];
    const InstanceState* state = state_of(instance);
    const cv::Scalar colour = state == nullptr ? colour_of(prior) : colour_of(*state);
    const cv::Point top = draw_outline(static_cast<int>(i) + 1, colour);
    if (state != nullptr || prior == FeatureVerdict::kStatic) continue;
    labels_.push_back({instance.class_name, top, colour});
  }
}

/// Gives the highest point of the biggest part, in the picture.
cv::Point Painter::draw_outline(int label, const cv::Scalar& colour) {
  std::vector<std::vector<cv::Point>> outlines;
  cv::findContours(view_.mask->labels == label, outlines, cv::RETR_EXTERNAL, cv::CHAIN_APPROX_NONE);
  for (std::vector<cv::Point>& outline : outlines) {
    for (cv::Point& point : outline) point = enlarged(point.x, point.y);
  }
  cv::polylines(image_, outlines, true, colour, 1, cv::LINE_AA);
  const auto biggest = std::ranges::max_element(outlines, {}, &std::vector<cv::Point>::size);
  if (biggest == outlines.end()) return {};
  return *std::ranges::min_element(*biggest, {}, &cv::Point::y);
}

void Painter::draw(const JudgedFeature& feature) {
  const cv::Point at = enlarged(feature.raw_x, feature.raw_y);
  cv::circle(image_, at, 3, colour_of(feature), cv::FILLED, cv::LINE_AA);
  if (feature.epipolar_px > kEpipolarOutlierPx) {
    cv::circle(image_, at, 7, kWhite, 1, cv::LINE_AA);
  }
}

/// What stays and is not expected to move would only hide the rest.
void Painter::draw(const InstanceState& state) {
  if (state.prior == FeatureVerdict::kStatic && !state.is_moving) return;
  const cv::Scalar colour = colour_of(state);
  const cv::Rect box(state.box.tl() * scale_, state.box.size() * scale_);
  cv::rectangle(image_, box, colour, state.is_moving ? 2 : 1, cv::LINE_AA);
  const std::string name = state.class_name.empty() ? "no class" : state.class_name;
  labels_.push_back(
      {name + " " + std::to_string(state.id) + "  " + fixed(state.p_moving, 2), box.tl(), colour});
}

/// On a dark ground that begins at the label's corner, but lies inside the picture.
void Painter::write(const Label& label) {
  const cv::Size size = cv::getTextSize(label.text, kFont, kFontScale, 1, nullptr);
  const cv::Size ground(size.width + 8, size.height + 8);
  const cv::Point corner(
      std::clamp(label.corner.x, 0, std::max(0, image_.cols - ground.width)),
      std::clamp(label.corner.y, 0, std::max(0, picture_height() - ground.height)));
  cv::rectangle(image_, cv::Rect(corner, ground), kDark, cv::FILLED);
  cv::putText(image_, label.text, {corner.x + 4, corner.y + ground.height - 4}, kFont, kFontScale,
              label.colour, 1, cv::LINE_AA);
}

void Painter::draw_legend() {
  struct Entry {
    const char* text;
    cv::Scalar colour;
    bool is_ring;
  };
  const std::array<Entry, 5> entries{{{"kept", kGreen, false},
                                      {"removed", kRed, false},
                                      {"removed, static class", kMagenta, false},
                                      {"off its epipolar line", kWhite, true},
                                      {"outline: may move", kAmber, false}}};
  const int y = picture_height() + kLegendHeight / 2;
  int x = 16;
  const auto put = [&](const std::string& text, const cv::Scalar& colour) {
    cv::putText(image_, text, {x, y + 5}, kFont, kFontScale, colour, 1, cv::LINE_AA);
    x += cv::getTextSize(text, kFont, kFontScale, 1, nullptr).width + 28;
  };
  for (const Entry& entry : entries) {
    cv::circle(image_, {x, y}, 6, entry.colour, entry.is_ring ? 1 : cv::FILLED, cv::LINE_AA);
    x += 14;
    put(entry.text, entry.colour);
  }
  const std::string age =
      view_.mask == nullptr
          ? "no mask"
          : "mask " + std::to_string(view_.seq - view_.mask->frame_seq) + " frames old";
  put("frame " + std::to_string(view_.seq) + ", " + age + (view_.is_tracked ? "" : ", LOST"),
      view_.is_tracked ? kWhite : kRed);
}

}  // namespace

cv::Mat draw_verdicts(const DebugView& view) { return Painter(view).paint(); }

}  // namespace tsg
