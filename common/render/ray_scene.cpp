#include "common/render/ray_scene.hpp"

#include <embree3/rtcore.h>

#include <algorithm>
#include <array>
#include <string>
#include <type_traits>

#include "common/core/check.hpp"
#include "common/core/error.hpp"

namespace tsg::render {
namespace {

constexpr std::size_t kPacket = 8;

template <typename Handle, void (*release)(Handle)>
struct Releaser {
  void operator()(Handle handle) const { release(handle); }
};
template <typename Handle, void (*release)(Handle)>
using Owned = std::unique_ptr<std::remove_pointer_t<Handle>, Releaser<Handle, release>>;

using Device = Owned<RTCDevice, rtcReleaseDevice>;
using Scene = Owned<RTCScene, rtcReleaseScene>;
using Geometry = Owned<RTCGeometry, rtcReleaseGeometry>;

Device make_device() {
  Device device(rtcNewDevice(nullptr));
  if (device) return device;
  throw FatalError(ExitCode::kUnavailable,
                   "Embree, which renders the pictures, does not start (its error " +
                       std::to_string(rtcGetDeviceError(nullptr)) +
                       "); it needs SSE2 or NEON and memory");
}

/// What the first `count` of eight lanes shall do: Embree takes -1 for on.
std::array<int, kPacket> lanes(std::size_t count) {
  std::array<int, kPacket> valid{};
  std::fill_n(valid.begin(), count, -1);
  return valid;
}

void fill(RTCRay8& packet, std::span<const Ray> rays) {
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const Ray& ray = rays[i];
    packet.org_x[i] = ray.origin.x();
    packet.org_y[i] = ray.origin.y();
    packet.org_z[i] = ray.origin.z();
    packet.dir_x[i] = ray.direction.x();
    packet.dir_y[i] = ray.direction.y();
    packet.dir_z[i] = ray.direction.z();
    packet.tnear[i] = 0.0F;
    packet.tfar[i] = ray.max_distance;
    packet.time[i] = 0.0F;
    packet.mask[i] = ~0U;
    packet.flags[i] = 0;
  }
}

}  // namespace

struct RayScene::Impl {
  Device device = make_device();
  Scene scene{rtcNewScene(device.get())};
  Geometry geometry{rtcNewGeometry(device.get(), RTC_GEOMETRY_TYPE_TRIANGLE)};
  std::size_t points = 0;
  std::size_t triangles = 0;

  explicit Impl(Use use) {
    const bool is_moving = use == Use::kMoving;
    rtcSetSceneBuildQuality(scene.get(),
                            is_moving ? RTC_BUILD_QUALITY_LOW : RTC_BUILD_QUALITY_MEDIUM);
    rtcSetGeometryBuildQuality(geometry.get(),
                               is_moving ? RTC_BUILD_QUALITY_LOW : RTC_BUILD_QUALITY_MEDIUM);
    // Robust: no ray slips through between two triangles that share an edge.
    rtcSetSceneFlags(scene.get(), RTC_SCENE_FLAG_ROBUST);
    rtcAttachGeometry(scene.get(), geometry.get());
  }

  void write_points(const std::vector<Eigen::Vector3f>& moved, float* buffer) const {
    TSG_CHECK(buffer != nullptr && moved.size() == points);
    for (const Eigen::Vector3f& point : moved) {
      buffer = std::copy_n(point.data(), 3, buffer);
    }
  }

  void commit() const {
    rtcCommitGeometry(geometry.get());
    rtcCommitScene(scene.get());
  }
};

RayScene::RayScene(Use use) : impl_(std::make_unique<Impl>(use)) {}
RayScene::RayScene(RayScene&&) noexcept = default;
RayScene& RayScene::operator=(RayScene&&) noexcept = default;
RayScene::~RayScene() = default;

void RayScene::set(const std::vector<Eigen::Vector3f>& points,
                   const std::vector<Triangle>& triangles) {
  impl_->points = points.size();
  impl_->triangles = triangles.size();
  if (triangles.empty()) return;
  RTCGeometry geometry = impl_->geometry.get();
  impl_->write_points(points, static_cast<float*>(rtcSetNewGeometryBuffer(
                                  geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                  3 * sizeof(float), points.size())));
  auto* corner = static_cast<std::uint32_t*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                              3 * sizeof(std::uint32_t), triangles.size()));
  TSG_CHECK(corner != nullptr);
  for (const Triangle& triangle : triangles) {
    corner = std::copy(triangle.corners.begin(), triangle.corners.end(), corner);
  }
  impl_->commit();
}

void RayScene::move(const std::vector<Eigen::Vector3f>& points) {
  if (is_empty()) return;
  RTCGeometry geometry = impl_->geometry.get();
  impl_->write_points(
      points, static_cast<float*>(rtcGetGeometryBufferData(geometry, RTC_BUFFER_TYPE_VERTEX, 0)));
  rtcUpdateGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0);
  impl_->commit();
}

void RayScene::cast(std::span<const Ray> rays, std::span<Hit> hits, Likeness likeness) const {
  TSG_CHECK(rays.size() == hits.size());
  std::ranges::fill(hits, Hit{});
  if (is_empty()) return;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  if (likeness == Likeness::kAlike) context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  for (std::size_t first = 0; first < rays.size(); first += kPacket) {
    const std::size_t count = std::min(kPacket, rays.size() - first);
    RTCRayHit8 packet;
    fill(packet.ray, rays.subspan(first, count));
    std::fill_n(packet.hit.geomID, kPacket, RTC_INVALID_GEOMETRY_ID);
    std::fill_n(packet.hit.instID[0], kPacket, RTC_INVALID_GEOMETRY_ID);
    alignas(32) const std::array<int, kPacket> valid = lanes(count);
    rtcIntersect8(valid.data(), impl_->scene.get(), &context, &packet);
    for (std::size_t i = 0; i < count; ++i) {
      if (packet.hit.geomID[i] == RTC_INVALID_GEOMETRY_ID) continue;
      hits[first + i] = {packet.ray.tfar[i], packet.hit.primID[i], packet.hit.u[i],
                         packet.hit.v[i]};
    }
  }
}

void RayScene::find_blocked(std::span<const Ray> rays, std::span<bool> blocked) const {
  TSG_CHECK(rays.size() == blocked.size());
  std::ranges::fill(blocked, false);
  if (is_empty()) return;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  for (std::size_t first = 0; first < rays.size(); first += kPacket) {
    const std::size_t count = std::min(kPacket, rays.size() - first);
    RTCRay8 packet;
    fill(packet, rays.subspan(first, count));
    alignas(32) const std::array<int, kPacket> valid = lanes(count);
    rtcOccluded8(valid.data(), impl_->scene.get(), &context, &packet);
    // Embree marks a blocked ray by a negative end.
    for (std::size_t i = 0; i < count; ++i) blocked[first + i] = packet.tfar[i] < 0.0F;
  }
}

bool RayScene::is_blocked(const Ray& ray) const {
  bool blocked = false;
  find_blocked({&ray, 1}, {&blocked, 1});
  return blocked;
}

bool RayScene::is_empty() const { return impl_->triangles == 0; }

}  // namespace tsg::render
