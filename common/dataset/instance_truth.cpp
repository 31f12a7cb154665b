#include "common/dataset/instance_truth.hpp"

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>
#include <utility>

#include "common/dataset/image_file.hpp"
#include "common/dataset/stamp.hpp"
#include "common/dataset/text_file.hpp"

namespace tsg {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr const char* kFix = "give a sequence with mask/ and instances.json";

KnownInstance parse_instance(const json& entry) {
  KnownInstance instance;
  instance.class_name = entry.at("cls").get<std::string>();
  instance.name = entry.value("name", "");
  instance.is_dynamic = entry.at("dynamic").get<bool>();
  if (!entry.contains("moving")) return instance;
  for (const auto& [stamp, moves] : entry.at("moving").items()) {
    if (const auto stamp_ns = parse_stamp_ns(stamp)) instance.moving[*stamp_ns] = moves.get<bool>();
  }
  return instance;
}

Expected<std::map<int, KnownInstance>> read_instances(const fs::path& path) {
  const auto text = read_text_file(path, kFix);
  if (!text) return tl::unexpected(text.error());
  std::map<int, KnownInstance> instances;
  try {
    const json root = json::parse(*text);
    for (const auto& [id, entry] : root.at("instances").items()) {
      instances[std::stoi(id)] = parse_instance(entry);
    }
  } catch (const std::exception& error) {  // of nlohmann and of stoi
    return make_error(ExitCode::kBadData, path.string() + " is not what it should be: " +
                                              error.what() + "; write it anew");
  }
  return instances;
}

Expected<std::vector<ListedImage>> list_masks(const fs::path& folder) {
  std::error_code error;
  fs::directory_iterator entries(folder, error);
  if (error) {
    return make_error(ExitCode::kMissingInput,
                      "there is no folder " + folder.string() + "; " + kFix);
  }
  std::vector<ListedImage> masks;
  for (const fs::directory_entry& entry : entries) {
    if (entry.path().extension() != ".png") continue;
    const auto stamp_ns = parse_stamp_ns(entry.path().stem().string());
    if (!stamp_ns) {
      return make_error(ExitCode::kBadData,
                        entry.path().string() + " is not named by its stamp; rename or remove it");
    }
    masks.push_back({*stamp_ns, entry.path()});
  }
  if (masks.empty()) {
    return make_error(ExitCode::kEmptyInput, folder.string() + " holds no mask; " + kFix);
  }
  std::sort(masks.begin(), masks.end(),
            [](const auto& a, const auto& b) { return a.stamp_ns < b.stamp_ns; });
  return masks;
}

const ListedImage& closest(const std::vector<ListedImage>& images, std::int64_t stamp_ns) {
  return *std::min_element(images.begin(), images.end(), [&](const auto& a, const auto& b) {
    return std::abs(a.stamp_ns - stamp_ns) < std::abs(b.stamp_ns - stamp_ns);
  });
}

MotionVerdict motion_at(const KnownInstance& instance, std::int64_t mask_stamp_ns) {
  if (!instance.is_dynamic) return MotionVerdict::kStatic;
  const auto moving = instance.moving.find(mask_stamp_ns);
  if (moving == instance.moving.end()) return MotionVerdict::kUnknown;
  return moving->second ? MotionVerdict::kMoving : MotionVerdict::kStatic;
}

/// What a mask shows of one id.
struct Region {
  int id = 0;
  int pixels = 0;
  int min_x = std::numeric_limits<int>::max();
  int min_y = std::numeric_limits<int>::max();
  int max_x = -1;
  int max_y = -1;

  void add(int x, int y) {
    ++pixels;
    min_x = std::min(min_x, x);
    min_y = std::min(min_y, y);
    max_x = std::max(max_x, x);
    max_y = std::max(max_y, y);
  }
  [[nodiscard]] cv::Rect2f box() const {
    return {static_cast<float>(min_x), static_cast<float>(min_y),
            static_cast<float>(max_x - min_x + 1), static_cast<float>(max_y - min_y + 1)};
  }
};

/// The regions of known ids, at most kMaxInstances of them, the biggest, by id.
std::vector<Region> find_regions(const cv::Mat& ids, const std::map<int, KnownInstance>& known) {
  std::map<int, Region> by_id;
  for (int y = 0; y < ids.rows; ++y) {
    const auto* row = ids.ptr<std::uint16_t>(y);
    for (int x = 0; x < ids.cols; ++x) {
      if (row[x] != 0) by_id[row[x]].add(x, y);
    }
  }
  std::vector<Region> regions;
  for (auto& [id, region] : by_id) {
    region.id = id;
    if (known.contains(id)) regions.push_back(region);
  }
  if (regions.size() > kMaxInstances) {
    std::stable_sort(regions.begin(), regions.end(),
                     [](const Region& a, const Region& b) { return a.pixels > b.pixels; });
    regions.resize(kMaxInstances);
    std::sort(regions.begin(), regions.end(),
              [](const Region& a, const Region& b) { return a.id < b.id; });
  }
  return regions;
}

/// Ids replaced by 1 + the index of their region; 0 for ids without one.
cv::Mat make_labels(const cv::Mat& ids, const std::vector<Region>& regions) {
  std::vector<std::uint8_t> label_of_id(std::numeric_limits<std::uint16_t>::max() + 1, 0);
  for (std::size_t i = 0; i < regions.size(); ++i) {
    label_of_id[static_cast<std::size_t>(regions[i].id)] = static_cast<std::uint8_t>(i + 1);
  }
  cv::Mat labels(ids.size(), CV_8UC1);
  std::transform(ids.begin<std::uint16_t>(), ids.end<std::uint16_t>(), labels.begin<std::uint8_t>(),
                 [&](std::uint16_t id) { return label_of_id[id]; });
  return labels;
}

}  // namespace

Expected<InstanceTruth> InstanceTruth::open(const fs::path& folder) {
  InstanceTruth truth;
  truth.folder_ = folder;
  auto instances = read_instances(folder / "instances.json");
  if (!instances) return tl::unexpected(instances.error());
  auto masks = list_masks(folder / "mask");
  if (!masks) return tl::unexpected(masks.error());
  truth.instances_ = std::move(*instances);
  truth.masks_ = std::move(*masks);
  return truth;
}

Expected<InstanceSegmentation> InstanceTruth::at(std::int64_t stamp_ns,
                                                 std::int64_t max_difference_ns) const {
  auto mask = mask_at(stamp_ns, max_difference_ns);
  if (!mask) return tl::unexpected(mask.error());
  return std::move(mask->segmentation);
}

Expected<TrueMask> InstanceTruth::mask_at(std::int64_t stamp_ns,
                                          std::int64_t max_difference_ns) const {
  const ListedImage& mask = closest(masks_, stamp_ns);
  if (std::abs(mask.stamp_ns - stamp_ns) > max_difference_ns) {
    return make_error(ExitCode::kMissingInput,
                      (folder_ / "mask").string() + " has no mask for stamp " +
                          format_stamp(stamp_ns, StampDecimals::kMicroseconds) +
                          "; give the folder of the sequence that is replayed");
  }
  const auto file = ImageFile::load(mask.path);
  if (!file) return tl::unexpected(file.error());
  const auto ids = file->decode_ids();
  if (!ids) return tl::unexpected(ids.error());
  const std::vector<Region> regions = find_regions(*ids, instances_);
  TrueMask result;
  result.segmentation.stamp_ns = stamp_ns;
  result.segmentation.labels = make_labels(*ids, regions);
  for (const Region& region : regions) {
    const KnownInstance& known = instances_.at(region.id);
    result.ids.push_back(region.id);
    result.segmentation.instances.push_back({.class_name = known.class_name,
                                             .score = 1.0F,
                                             .box = region.box(),
                                             .motion = motion_at(known, mask.stamp_ns),
                                             .track_id = static_cast<std::uint32_t>(region.id)});
  }
  return result;
}

}  // namespace tsg
