#include "common/rgbd/mask_faults.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <opencv2/imgproc.hpp>
#include <utility>

namespace tsg {
namespace {

constexpr int kMostFrames = 300;  // ten seconds: as good as never
constexpr int kMostPixels = 100;

void check_range(std::vector<std::string>& found, const std::string& key, int value, int least) {
  const int most = key == "shrink_px" ? kMostPixels : kMostFrames;
  if (value >= least && value <= most) return;
  found.push_back(key + " must be " + std::to_string(least) + " to " + std::to_string(most));
}

bool is_turn(std::uint64_t count, int every) {
  return every > 0 && count % static_cast<std::uint64_t>(every) == 0;
}

using LabelTable = std::array<std::uint8_t, 256>;

LabelTable identity() {
  LabelTable table{};
  for (std::size_t i = 0; i < table.size(); ++i) table.at(i) = static_cast<std::uint8_t>(i);
  return table;
}

void relabel(cv::Mat& labels, LabelTable table) {
  cv::LUT(labels, cv::Mat(1, static_cast<int>(table.size()), CV_8UC1, table.data()), labels);
}

/// Takes instance `index` out; its pixels become those of `heir`, a label, or none (0).
void remove_instance(InstanceSegmentation& mask, std::size_t index, std::uint8_t heir) {
  LabelTable table = identity();
  for (std::size_t label = index + 2; label < table.size(); ++label) --table.at(label);
  table.at(index + 1) = heir == 0 ? std::uint8_t{0} : table.at(heir);
  relabel(mask.labels, table);
  mask.instances.erase(mask.instances.begin() + static_cast<std::ptrdiff_t>(index));
}

using LabelCounts = std::array<int, 256>;

LabelCounts count_pixels(const cv::Mat& labels) {
  LabelCounts counts{};
  for (int y = 0; y < labels.rows; ++y) {
    const auto* row = labels.ptr<std::uint8_t>(y);
    for (int x = 0; x < labels.cols; ++x) ++counts.at(row[x]);
  }
  return counts;
}

/// How many pixels of each two instances are neighbours, to the right or below.
class Borders {
 public:
  Borders(const cv::Mat& labels, std::size_t instances)
      : instances_(instances), lengths_(instances * instances, 0) {
    for (int y = 0; y < labels.rows; ++y) {
      const auto* row = labels.ptr<std::uint8_t>(y);
      const auto* below = labels.ptr<std::uint8_t>(std::min(y + 1, labels.rows - 1));
      for (int x = 0; x < labels.cols; ++x) {
        add(row[x], row[std::min(x + 1, labels.cols - 1)]);
        add(row[x], below[x]);
      }
    }
  }
  [[nodiscard]] int between(std::size_t a, std::size_t b) const {
    return lengths_[a * instances_ + b] + lengths_[b * instances_ + a];
  }

 private:
  void add(std::uint8_t label, std::uint8_t other) {
    if (label == other || label == 0 || other == 0) return;
    ++lengths_[(label - 1U) * instances_ + (other - 1U)];
  }
  std::size_t instances_;
  std::vector<int> lengths_;
};

float gap_px(const cv::Rect2f& a, const cv::Rect2f& b) {
  const float x = std::max({a.x - (b.x + b.width), b.x - (a.x + a.width), 0.0F});
  const float y = std::max({a.y - (b.y + b.height), b.y - (a.y + a.height), 0.0F});
  return std::hypot(x, y);
}

/// Which two belong together most: by their common border, then by the gap between their boxes.
std::pair<std::size_t, std::size_t> closest_two(const InstanceSegmentation& mask) {
  const Borders borders(mask.labels, mask.instances.size());
  std::pair<std::size_t, std::size_t> closest{0, 1};
  std::pair<int, float> least{std::numeric_limits<int>::max(), 0.0F};
  for (std::size_t a = 0; a < mask.instances.size(); ++a) {
    for (std::size_t b = a + 1; b < mask.instances.size(); ++b) {
      const std::pair<int, float> distance{-borders.between(a, b),
                                           gap_px(mask.instances[a].box, mask.instances[b].box)};
      if (distance >= least) continue;
      least = distance;
      closest = {a, b};
    }
  }
  return closest;
}

void merge_two(InstanceSegmentation& mask) {
  if (mask.instances.size() < 2) return;
  const LabelCounts pixels = count_pixels(mask.labels);
  auto [bigger, smaller] = closest_two(mask);
  if (pixels.at(smaller + 1) > pixels.at(bigger + 1)) std::swap(bigger, smaller);
  mask.instances[bigger].box |= mask.instances[smaller].box;
  remove_instance(mask, smaller, static_cast<std::uint8_t>(bigger + 1));
}

/// A pixel stays where all pixels around it belong to the same instance.
void shrink(InstanceSegmentation& mask, int pixels) {
  const LabelCounts before = count_pixels(mask.labels);
  const int side = 2 * pixels + 1;
  const cv::Mat around = cv::getStructuringElement(cv::MORPH_RECT, {side, side});
  cv::Mat least;
  cv::Mat most;
  cv::erode(mask.labels, least, around);
  cv::dilate(mask.labels, most, around);
  mask.labels.setTo(0, least != most);
  const LabelCounts after = count_pixels(mask.labels);
  for (std::size_t i = mask.instances.size(); i-- > 0;) {
    const bool is_gone = before.at(i + 1) > 0 && after.at(i + 1) == 0;
    if (is_gone) {
      remove_instance(mask, i, 0);
    } else if (after.at(i + 1) > 0) {
      mask.instances[i].box = cv::boundingRect(mask.labels == static_cast<int>(i + 1));
    }
  }
}

std::string wrong_class(const std::string& right) { return right == "person" ? "chair" : "person"; }

}  // namespace

bool MaskFaults::any() const { return !to_text(*this).empty(); }

std::vector<std::string> MaskFaults::problems() const {
  std::vector<std::string> found;
  check_range(found, "late_frames", late_frames, 0);
  check_range(found, "every_frames", every_frames, 1);
  check_range(found, "drop_every", drop_every, 0);
  check_range(found, "drop_instance_every", drop_instance_every, 0);
  check_range(found, "shrink_px", shrink_px, 0);
  check_range(found, "swap_class_every", swap_class_every, 0);
  return found;
}

std::string to_text(const MaskFaults& faults) {
  const MaskFaults none;
  std::string text;
  const auto add = [&](const char* key, int value, int off) {
    if (value == off) return;
    text += (text.empty() ? "" : ", ") + std::string(key) + "=" + std::to_string(value);
  };
  add("late_frames", faults.late_frames, none.late_frames);
  add("every_frames", faults.every_frames, none.every_frames);
  add("drop_every", faults.drop_every, none.drop_every);
  add("drop_instance_every", faults.drop_instance_every, none.drop_instance_every);
  if (faults.merge_two) text += std::string(text.empty() ? "" : ", ") + "merge_two=true";
  add("shrink_px", faults.shrink_px, none.shrink_px);
  add("swap_class_every", faults.swap_class_every, none.swap_class_every);
  return text;
}

bool MaskFaultInjector::is_segmented(std::uint64_t seq) const {
  return is_turn(seq, faults_.every_frames);
}

std::optional<InstanceSegmentation> MaskFaultInjector::apply(InstanceSegmentation mask) {
  if (!faults_.any()) return mask;
  ++masks_;
  if (is_turn(masks_, faults_.drop_every)) return std::nullopt;
  mask.labels = mask.labels.clone();
  if (is_turn(masks_, faults_.drop_instance_every) && !mask.instances.empty()) {
    remove_instance(mask, dropped_instances_++ % mask.instances.size(), 0);
  }
  if (is_turn(masks_, faults_.swap_class_every) && !mask.instances.empty()) {
    std::string& name = mask.instances[swapped_classes_++ % mask.instances.size()].class_name;
    name = wrong_class(name);
  }
  if (faults_.merge_two) merge_two(mask);
  if (faults_.shrink_px > 0) shrink(mask, faults_.shrink_px);
  return mask;
}

}  // namespace tsg
