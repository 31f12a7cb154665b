#include "services/map_server/lib/class_table.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>

namespace tsg {
namespace {

constexpr std::size_t kHues = 20;
constexpr std::size_t kShades = 4;

constexpr std::array<std::string_view, 80> kCocoNames{
    "person",        "bicycle",      "car",
    "motorcycle",    "airplane",     "bus",
    "train",         "truck",        "boat",
    "traffic light", "fire hydrant", "stop sign",
    "parking meter", "bench",        "bird",
    "cat",           "dog",          "horse",
    "sheep",         "cow",          "elephant",
    "bear",          "zebra",        "giraffe",
    "backpack",      "umbrella",     "handbag",
    "tie",           "suitcase",     "frisbee",
    "skis",          "snowboard",    "sports ball",
    "kite",          "baseball bat", "baseball glove",
    "skateboard",    "surfboard",    "tennis racket",
    "bottle",        "wine glass",   "cup",
    "fork",          "knife",        "spoon",
    "bowl",          "banana",       "apple",
    "sandwich",      "orange",       "broccoli",
    "carrot",        "hot dog",      "pizza",
    "donut",         "cake",         "chair",
    "couch",         "potted plant", "bed",
    "dining table",  "toilet",       "tv",
    "laptop",        "mouse",        "remote",
    "keyboard",      "cell phone",   "microwave",
    "oven",          "toaster",      "sink",
    "refrigerator",  "book",         "clock",
    "vase",          "scissors",     "teddy bear",
    "hair drier",    "toothbrush"};

/// `hue` in turns of the colour wheel, the others 0..1.
Rgb from_hsv(double hue, double saturation, double value) {
  const auto channel = [&](double offset) {
    const double k = std::fmod(offset + hue * 6.0, 6.0);
    const double level = value * (1.0 - saturation * std::clamp(std::min(k, 4.0 - k), 0.0, 1.0));
    return static_cast<std::uint8_t>(std::lround(255.0 * level));
  };
  return {channel(5.0), channel(3.0), channel(1.0)};
}

/// The colour with number `index` of a palette of kHues * kShades.
Rgb palette_colour(std::size_t index) {
  struct Shade {
    double saturation;
    double value;
  };
  constexpr std::array<Shade, kShades> kShadeTable{
      {{0.85, 0.95}, {0.50, 0.95}, {0.90, 0.65}, {0.50, 0.70}}};
  // 11 is coprime to the number of hues, so neighbours in COCO's order lie far apart on the wheel;
  // every lap around the wheel moves on to the next shade.
  const std::size_t hue = index * 11 % kHues;
  const std::size_t shade = (index + index / kHues) % kShades;
  return from_hsv(static_cast<double>(hue) / static_cast<double>(kHues),
                  kShadeTable[shade].saturation, kShadeTable[shade].value);
}

/// FNV-1a: std::hash may differ between machines, and colours must not.
std::size_t stable_hash(std::string_view text) {
  std::uint64_t hash = 14695981039346656037ULL;
  for (const char character : text) {
    hash = (hash ^ static_cast<unsigned char>(character)) * 1099511628211ULL;
  }
  return static_cast<std::size_t>(hash);
}

}  // namespace

Rgb class_colour(std::string_view name) {
  const auto* const found = std::find(kCocoNames.begin(), kCocoNames.end(), name);
  if (found == kCocoNames.end()) return palette_colour(stable_hash(name) % (kHues * kShades));
  return palette_colour(static_cast<std::size_t>(std::distance(kCocoNames.begin(), found)));
}

ClassTable::ClassTable() {
  names_[kBackgroundClass] = "background";
  names_[kNotSegmentedClass] = "not segmented";
  names_[kOtherClass] = "other";
  colours_[kOtherClass] = class_colour("other");
  for (const std::string_view name : kCocoNames) add(static_cast<ClassId>(used_ + 1), name);
}

ClassId ClassTable::id_of(std::string_view name) {
  auto* const end = names_.begin() + 1 + used_;
  auto* const found = std::find(names_.begin() + 1, end, name);
  if (found != end) return static_cast<ClassId>(std::distance(names_.begin(), found));
  const int next = used_ + 1;
  return next < kOtherClass ? add(static_cast<ClassId>(next), name) : kOtherClass;
}

ClassId ClassTable::add(ClassId id, std::string_view name) {
  names_[id] = name;
  colours_[id] = class_colour(name);
  ++used_;
  return id;
}

}  // namespace tsg
