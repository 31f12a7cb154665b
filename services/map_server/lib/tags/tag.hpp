#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <string>
#include <string_view>

#include "services/map_server/lib/cloud.hpp"

namespace tsg {

/// What became of an object.
enum class TagState {
  kStatic,  ///< stands where it was seen
  kMoved,   ///< has been seen to move, and stands at another place now
  kGone,    ///< its place has been seen free since
};

[[nodiscard]] std::string_view name_of(TagState state);

/// A box that stands upright, turned about the vertical axis of the map.
struct UprightBox {
  Eigen::Vector3f centre = Eigen::Vector3f::Zero();  ///< metres, map frame
  Eigen::Vector3f size = Eigen::Vector3f::Zero();    ///< metres along its own axes; z is up
  float yaw_rad = 0.0F;                              ///< of its x axis, -pi/2..pi/2
};

/// A semantic tag (paper, Algorithm 1): one object of the map.
struct Tag {
  std::uint32_t id = 0;  ///< from 1; never given again, kept over corrections and restarts
  std::string class_name;
  Cloud cloud;                                       ///< map frame
  Eigen::Vector3f centre = Eigen::Vector3f::Zero();  ///< of oriented_box
  Eigen::AlignedBox3f box;                           ///< along the axes of the map
  UprightBox oriented_box;
  int observations = 0;     ///< keyframes that showed it
  float confidence = 0.0F;  ///< 0..1
  std::int64_t first_seen_ns = 0;
  std::int64_t last_seen_ns = 0;
  TagState state = TagState::kStatic;
};

/// Whether the object still stands at the tag's place.
[[nodiscard]] inline bool is_present(const Tag& tag) { return tag.state != TagState::kGone; }

}  // namespace tsg
