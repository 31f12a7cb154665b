#pragma once

#include <Eigen/Core>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "common/core/error.hpp"
#include "common/geometry/se3.hpp"
#include "common/render/mesh.hpp"
#include "common/simulation/furniture/catalogue.hpp"
#include "common/simulation/scene.hpp"

namespace tsg::simulation {

/// A thing that people may use: its first pose and what one must know to sit on it or to push it.
struct Prop {
  SE3 T_world_object;
  std::optional<Seat> seat;
  Eigen::Vector2d half_size_m = Eigen::Vector2d::Zero();
  double grip_height_m = 0.9;
  double top_m = 0.0;  ///< above its base: where a thing comes to stand that is put down on it
};

/// What all people do and where the things go that they push and carry, as functions of time.
/// Deterministic; safe to read from several threads.
///
/// * Who sits as the first action and starts within 0.5 m of the seat sits there from the outset;
///   others walk to the seat and turn. Durations count from when they have come to sit or to face
///   `yaw_rad`.
/// * The path of a push is that of the object. One walks behind its back (a thing without a seat:
///   to the side that the way asks for), turns it about itself where the path sets off elsewhere,
///   and lets go at the end.
/// * What is carried is fetched from where it is, at the side from which one comes, and put down
///   0.5 m ahead after the last action in a row that carries it: on top of the prop that is there,
///   else on the floor.
/// * An object serves one person at a time; others wait where they are until it is free.
/// * Who repeats does so for an hour.
class Choreography {
 public:
  /// kBadData names the person, the action and what is wrong with it (an unknown object, nothing to
  /// sit on, a path without corners).
  [[nodiscard]] static Expected<Choreography> plan(const std::vector<PersonDescription>& people,
                                                   const std::map<std::string, Prop>& props,
                                                   std::uint64_t seed);

  Choreography(Choreography&& other) noexcept;
  Choreography& operator=(Choreography&& other) noexcept;
  Choreography(const Choreography&) = delete;
  Choreography& operator=(const Choreography&) = delete;
  ~Choreography();

  [[nodiscard]] std::size_t people() const;
  /// The person at rest, with clothes, hair and face; topology, uv and materials hold for all
  /// times.
  [[nodiscard]] const render::Mesh& mesh(std::size_t person) const;
  /// World coordinates of all its points and normals at `time_s`; the vectors are resized to fit.
  void pose(std::size_t person,
            double time_s,
            std::vector<Eigen::Vector3f>& points,
            std::vector<Eigen::Vector3f>& normals) const;

  /// Objects that somebody pushes, pulls or carries at any time.
  [[nodiscard]] std::vector<std::string> moved_objects() const;
  /// Its pose; before and after it is moved it stands where it is.
  [[nodiscard]] SE3 T_world_object(const std::string& object, double time_s) const;

 private:
  struct Impl;
  explicit Choreography(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace tsg::simulation
