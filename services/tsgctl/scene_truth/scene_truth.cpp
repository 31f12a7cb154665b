#include "services/tsgctl/scene_truth/scene_truth.hpp"

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "common/core/atomic_file.hpp"
#include "common/dataset/stamp.hpp"
#include "common/dataset/text_file.hpp"

namespace tsg {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr const char* kObjectsFile = "truth_objects.json";
constexpr const char* kPeopleFile = "truth_people.bt";
constexpr const char* kSurfacesFile = "truth_surfaces.bt";
constexpr const char* kFix = "render the sequence with 'tsgctl simulate'";
constexpr double kDegreesPerRadian = 180.0 / M_PI;

/// To a tenth of a millimetre: a float's digits beyond that are noise.
double rounded(double value) { return std::round(1e4 * value) / 1e4; }

json to_json(const Eigen::Vector3f& vector) {
  return json::array({rounded(vector.x()), rounded(vector.y()), rounded(vector.z())});
}

json to_json(const TrueBox& box) {
  return {{"from", format_stamp(box.from_ns, StampDecimals::kMicroseconds)},
          {"centre_m", to_json(box.centre_m)},
          {"size_m", to_json(box.size_m)},
          {"yaw_deg", rounded(kDegreesPerRadian * box.yaw_rad)}};
}

std::string to_text(const std::vector<TrueObject>& objects) {
  json list = json::array();
  for (const TrueObject& object : objects) {
    json boxes = json::array();
    for (const TrueBox& box : object.boxes) boxes.push_back(to_json(box));
    list.push_back({{"id", object.id},
                    {"class", object.class_name},
                    {"name", object.name},
                    {"boxes", std::move(boxes)}});
  }
  return json{{"frame", "world of groundtruth.txt"}, {"objects", std::move(list)}}.dump(1) + "\n";
}

Eigen::Vector3f parse_vector(const json& value) {
  const auto numbers = value.get<std::array<float, 3>>();
  return {numbers[0], numbers[1], numbers[2]};
}

/// Throws std::exception where `value` is not what to_json() makes.
TrueBox parse_box(const json& value) {
  const auto from_ns = parse_stamp_ns(value.at("from").get<std::string>());
  if (!from_ns) throw std::invalid_argument("\"from\" is no stamp");
  return {.from_ns = *from_ns,
          .centre_m = parse_vector(value.at("centre_m")),
          .size_m = parse_vector(value.at("size_m")),
          .yaw_rad = static_cast<float>(value.at("yaw_deg").get<double>() / kDegreesPerRadian)};
}

/// The same.
TrueObject parse_object(const json& value) {
  TrueObject object{.id = value.at("id").get<int>(),
                    .class_name = value.at("class").get<std::string>(),
                    .name = value.at("name").get<std::string>(),
                    .boxes = {}};
  for (const json& box : value.at("boxes")) object.boxes.push_back(parse_box(box));
  if (object.boxes.empty()) throw std::invalid_argument("object without a box");
  return object;
}

Expected<std::vector<TrueObject>> read_objects(const fs::path& path) {
  const auto text = read_text_file(path, kFix);
  if (!text) return tl::unexpected(text.error());
  std::vector<TrueObject> objects;
  try {
    const json root = json::parse(*text);
    for (const json& object : root.at("objects")) objects.push_back(parse_object(object));
  } catch (const std::exception& error) {  // of nlohmann and of parse_box()
    return make_error(ExitCode::kBadData, path.string() + " is not what it should be: " +
                                              error.what() + "; " + kFix + " anew");
  }
  return objects;
}

Expected<VoxelSet> read_voxels(const fs::path& path) {
  return read_text_file(path, kFix).and_then([&](const std::string& bytes) {
    return VoxelSet::from_bt(bytes, path.string());
  });
}

}  // namespace

const TrueBox& TrueObject::box_at(std::int64_t stamp_ns) const {
  const TrueBox* last = &boxes.front();
  for (const TrueBox& box : boxes) {
    if (box.from_ns <= stamp_ns) last = &box;
  }
  return *last;
}

bool has_scene_truth(const fs::path& folder) {
  std::error_code absent;
  return fs::exists(folder / kObjectsFile, absent);
}

Expected<void> write_scene_truth(const fs::path& folder, SceneTruth& truth) {
  return write_file_atomically(folder / kPeopleFile, truth.swept_by_people.to_bt())
      .and_then(
          [&] { return write_file_atomically(folder / kSurfacesFile, truth.surfaces.to_bt()); })
      .and_then(
          [&] { return write_file_atomically(folder / kObjectsFile, to_text(truth.objects)); });
}

Expected<SceneTruth> read_scene_truth(const fs::path& folder) {
  auto objects = read_objects(folder / kObjectsFile);
  if (!objects) return tl::unexpected(objects.error());
  auto people = read_voxels(folder / kPeopleFile);
  if (!people) return tl::unexpected(people.error());
  auto surfaces = read_voxels(folder / kSurfacesFile);
  if (!surfaces) return tl::unexpected(surfaces.error());
  return SceneTruth{std::move(*objects), std::move(*people), std::move(*surfaces)};
}

}  // namespace tsg
