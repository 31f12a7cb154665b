#include <cmath>
#include <utility>

#include "common/map_file/bytes.hpp"
#include "services/slam/lib/map_encoding.hpp"

namespace tsg {
namespace {

// Least that each thing takes, so that a count can be told to be impossible.
constexpr std::size_t kDescriptorSize = 32;
constexpr std::size_t kFeatureSize = 22 + kDescriptorSize + 1;
constexpr std::size_t kPoseSize = 56;
constexpr std::size_t kKeyframeSize = 28 + kPoseSize + 16;
constexpr std::size_t kObservationSize = 12;
constexpr std::size_t kPointSize = 80 + kDescriptorSize + 16;
constexpr std::size_t kCulledSize = 32 + kPoseSize;
constexpr std::size_t kLoopSize = 16 + kPoseSize;
/// Fits the 16-bit indices of grids and place index; feature extraction stays far below.
constexpr std::size_t kMaxFeatures = 16'000;

/// Reads a map number by number. What is wrong is kept by the ByteReader.
class MapDecoder {
 public:
  MapDecoder(std::string_view bytes, const CameraModel& camera, const MapFeatureSettings& settings)
      : in_(bytes), camera_(camera), settings_(settings) {}

  MapContents decode() {
    MapContents contents;
    contents.camera = camera_;
    contents.newest = in_.get<std::uint64_t>();
    contents.next_point = in_.get<std::uint64_t>();
    contents.is_adjusting = get_bool();
    contents.keyframes.resize(in_.get_count(kKeyframeSize));
    for (Keyframe& keyframe : contents.keyframes) keyframe = get_keyframe();
    contents.points.resize(in_.get_count(kPointSize));
    for (MapPoint& point : contents.points) point = get_point();
    get_culled(contents);
    contents.loops.resize(in_.get_count(kLoopSize));
    for (LoopEdge& loop : contents.loops) loop = get_loop();
    contents.recent_points.resize(in_.get_count(sizeof(PointId)));
    for (PointId& id : contents.recent_points) id = in_.get<std::uint64_t>();
    if (in_.left() > 0) in_.fail("bytes are left at its end");
    return contents;
  }
  [[nodiscard]] const std::string& problem() const { return in_.problem(); }

 private:
  bool get_bool() {
    const auto value = in_.get<std::uint8_t>();
    if (value > 1) in_.fail("a yes or no is neither");
    return value == 1;
  }

  Descriptor get_descriptor() {
    Descriptor descriptor{};
    for (std::uint64_t& word : descriptor) word = in_.get<std::uint64_t>();
    return descriptor;
  }

  float get_inverse_depth() {
    const auto inverse_depth = in_.get<float>();
    if (!(inverse_depth >= 0.0F) || !std::isfinite(inverse_depth)) in_.fail("a depth is no number");
    return inverse_depth;
  }

  Feature get_feature() {
    Feature feature;
    feature.pixel.x() = in_.get<float>();
    feature.pixel.y() = in_.get<float>();
    feature.inverse_depth = get_inverse_depth();
    feature.angle = in_.get<float>();
    feature.raw_x = in_.get<std::int16_t>();
    feature.raw_y = in_.get<std::int16_t>();
    feature.level = in_.get<std::uint8_t>();
    const auto verdict = in_.get<std::uint8_t>();
    feature.verdict = static_cast<FeatureVerdict>(verdict);
    const bool is_in_image = feature.raw_x >= 0 && feature.raw_x < camera_.width &&
                             feature.raw_y >= 0 && feature.raw_y < camera_.height;
    const bool is_finite = feature.pixel.allFinite() && std::isfinite(feature.angle);
    if (!is_in_image || !is_finite || feature.level >= settings_.levels ||
        verdict > static_cast<std::uint8_t>(FeatureVerdict::kDynamic)) {
      in_.fail("a feature lies outside the image or its pyramid");
    }
    return feature;
  }

  Surface get_surface() {
    Surface surface;
    surface.columns = in_.get<std::int32_t>();
    surface.rows = in_.get<std::int32_t>();
    const bool is_absent = surface.columns == 0 && surface.rows == 0;
    const bool fits = surface.columns == (camera_.width - 1) / kSurfaceCell + 1 &&
                      surface.rows == (camera_.height - 1) / kSurfaceCell + 1;
    if (!is_absent && !fits) in_.fail("a surface does not fit the image");
    if (!in_.is_ok()) return {};
    const std::size_t cells = surface.index(0, surface.rows);
    if (cells > in_.left() / sizeof(float)) in_.fail("a surface is cut short");
    if (!in_.is_ok()) return {};
    surface.inverse_depths.resize(cells);
    for (float& inverse_depth : surface.inverse_depths) inverse_depth = get_inverse_depth();
    return surface;
  }

  Keyframe get_keyframe() {
    Keyframe keyframe;
    auto features = std::make_shared<Features>();
    keyframe.id = in_.get<std::uint64_t>();
    keyframe.part = in_.get<std::uint32_t>();
    features->seq = in_.get<std::uint64_t>();
    features->stamp_ns = in_.get<std::int64_t>();
    keyframe.T_world_camera = in_.get_pose();
    const std::size_t count = in_.get_count(kFeatureSize);
    if (count > kMaxFeatures) in_.fail("a keyframe has " + std::to_string(count) + " features");
    if (!in_.is_ok()) return keyframe;
    features->items.reserve(count);
    features->descriptors.reserve(count);
    keyframe.banned.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
      features->items.push_back(get_feature());
      features->descriptors.push_back(get_descriptor());
      keyframe.banned.push_back(get_bool());
    }
    features->surface = get_surface();
    if (!in_.is_ok()) return keyframe;  // the grid trusts what it is given
    features->grid = FeatureGrid(features->items, camera_.width, camera_.height);
    keyframe.features = std::move(features);
    keyframe.points.assign(count, kNoPoint);
    return keyframe;
  }

  MapPoint get_point() {
    MapPoint point;
    point.id = in_.get<std::uint64_t>();
    point.position = in_.get_vector();
    point.normal = in_.get_vector();
    point.min_distance = in_.get<double>();
    point.max_distance = in_.get<double>();
    point.descriptor = get_descriptor();
    point.created_in = in_.get<std::uint64_t>();
    point.expected = in_.get<std::int32_t>();
    point.found = in_.get<std::int32_t>();
    if (!point.position.allFinite() || !point.normal.allFinite() ||
        !std::isfinite(point.min_distance) || !std::isfinite(point.max_distance)) {
      in_.fail("a point is at no place");
    }
    point.observations.resize(in_.get_count(kObservationSize));
    for (Observation& observation : point.observations) {
      observation.keyframe = in_.get<std::uint64_t>();
      observation.feature = in_.get<std::int32_t>();
    }
    return point;
  }

  void get_culled(MapContents& contents) {
    const std::size_t count = in_.get_count(kCulledSize);
    for (std::size_t i = 0; i < count; ++i) {
      const auto id = in_.get<std::uint64_t>();
      CulledKeyframe keyframe;
      keyframe.parent = in_.get<std::uint64_t>();
      keyframe.T_parent_camera = in_.get_pose();
      keyframe.seq = in_.get<std::uint64_t>();
      keyframe.stamp_ns = in_.get<std::int64_t>();
      if (!contents.culled.emplace(id, keyframe).second) in_.fail("a keyframe is culled twice");
    }
  }

  LoopEdge get_loop() {
    LoopEdge loop;
    loop.a = in_.get<std::uint64_t>();
    loop.b = in_.get<std::uint64_t>();
    loop.T_a_b = in_.get_pose();
    return loop;
  }

  ByteReader in_;
  const CameraModel& camera_;
  const MapFeatureSettings& settings_;
};

}  // namespace

Expected<MapContents> decode_map(std::string_view bytes,
                                 const CameraModel& camera,
                                 const MapFeatureSettings& features) {
  MapDecoder decoder(bytes, camera, features);
  MapContents contents = decoder.decode();
  if (!decoder.problem().empty()) return make_error(ExitCode::kBadData, decoder.problem());
  const std::string inconsistency = find_inconsistency(contents);
  if (!inconsistency.empty()) return make_error(ExitCode::kBadData, inconsistency);
  return contents;
}

}  // namespace tsg
