#include "services/slam/lib/map_encoding.hpp"

#include "common/map_file/bytes.hpp"

namespace tsg {
namespace {

constexpr std::size_t kBytesPerKeyframe = 100'000;  // of a thousand features: what to reserve

void put_feature(const Feature& feature, ByteWriter& out) {
  out.put<float>(feature.pixel.x());
  out.put<float>(feature.pixel.y());
  out.put<float>(feature.inverse_depth);
  out.put<float>(feature.angle);
  out.put<std::int16_t>(feature.raw_x);
  out.put<std::int16_t>(feature.raw_y);
  out.put<std::uint8_t>(feature.level);
  out.put<std::uint8_t>(static_cast<std::uint8_t>(feature.verdict));
}

void put_descriptor(const Descriptor& descriptor, ByteWriter& out) {
  for (const std::uint64_t word : descriptor) out.put<std::uint64_t>(word);
}

void put_keyframe(const Keyframe& keyframe, ByteWriter& out) {
  const Features& features = *keyframe.features;
  out.put<std::uint64_t>(keyframe.id);
  out.put<std::uint32_t>(keyframe.part);
  out.put<std::uint64_t>(features.seq);
  out.put<std::int64_t>(features.stamp_ns);
  out.put(keyframe.T_world_camera);
  out.put<std::uint64_t>(features.size());
  for (std::size_t i = 0; i < features.size(); ++i) {
    put_feature(features.items[i], out);
    put_descriptor(features.descriptors[i], out);
    out.put<std::uint8_t>(keyframe.banned[i] ? 1 : 0);
  }
  out.put<std::int32_t>(features.surface.columns);
  out.put<std::int32_t>(features.surface.rows);
  for (const float inverse_depth : features.surface.inverse_depths) out.put<float>(inverse_depth);
}

void put_point(const MapPoint& point, ByteWriter& out) {
  out.put<std::uint64_t>(point.id);
  out.put(point.position);
  out.put(point.normal);
  out.put<double>(point.min_distance);
  out.put<double>(point.max_distance);
  put_descriptor(point.descriptor, out);
  out.put<std::uint64_t>(point.created_in);
  out.put<std::int32_t>(point.expected);
  out.put<std::int32_t>(point.found);
  out.put<std::uint64_t>(point.observations.size());
  for (const Observation& observation : point.observations) {
    out.put<std::uint64_t>(observation.keyframe);
    out.put<std::int32_t>(observation.feature);
  }
}

void put_culled(KeyframeId id, const CulledKeyframe& keyframe, ByteWriter& out) {
  out.put<std::uint64_t>(id);
  out.put<std::uint64_t>(keyframe.parent);
  out.put(keyframe.T_parent_camera);
  out.put<std::uint64_t>(keyframe.seq);
  out.put<std::int64_t>(keyframe.stamp_ns);
}

}  // namespace

std::string encode_map(const MapContents& contents) {
  ByteWriter out;
  out.reserve(contents.keyframes.size() * kBytesPerKeyframe);
  out.put<std::uint64_t>(contents.newest);
  out.put<std::uint64_t>(contents.next_point);
  out.put<std::uint8_t>(contents.is_adjusting ? 1 : 0);
  out.put<std::uint64_t>(contents.keyframes.size());
  for (const Keyframe& keyframe : contents.keyframes) put_keyframe(keyframe, out);
  out.put<std::uint64_t>(contents.points.size());
  for (const MapPoint& point : contents.points) put_point(point, out);
  out.put<std::uint64_t>(contents.culled.size());
  for (const auto& [id, keyframe] : contents.culled) put_culled(id, keyframe, out);
  out.put<std::uint64_t>(contents.loops.size());
  for (const LoopEdge& loop : contents.loops) {
    out.put<std::uint64_t>(loop.a);
    out.put<std::uint64_t>(loop.b);
    out.put(loop.T_a_b);
  }
  out.put<std::uint64_t>(contents.recent_points.size());
  for (const PointId id : contents.recent_points) out.put<std::uint64_t>(id);
  return out.take();
}

}  // namespace tsg
