#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "common/render/baked_light.hpp"
#include "common/render/bounced_light_field.hpp"
#include "common/render/lamp.hpp"
#include "common/render/layer.hpp"

namespace tsg::render {

/// What is seen along a ray.
struct Sighting {
  Hit hit;
  bool is_body = false;  ///< of the bodies rather than the fixed parts
};

/// A lit set: fixed parts whose light is computed once, and bodies that move. Casting and reading
/// is thread-safe; pose_body(), update() and light_up() are not.
class Stage {
 public:
  /// Bakes the light of the fixed parts. Bodies stand where their meshes say until they are posed.
  Stage(const std::vector<Part>& fixed, const std::vector<Part>& bodies, std::vector<Lamp> lamps);

  /// Moves a body: world coordinates of its points and normals, and how far each point moves while
  /// the shutter is open (metres).
  void pose_body(std::size_t body,
                 std::span<const Eigen::Vector3f> points,
                 std::span<const Eigen::Vector3f> normals,
                 std::span<const Eigen::Vector3f> travel);
  /// Takes the new poses over.
  void update();

  /// What neighbouring rays meet first; as long as `rays`.
  void look(std::span<const Ray> rays, std::span<Sighting> sightings) const;

  /// Computes light at the corners that were seen, for the present poses: shadows that bodies
  /// throw, and light on them.
  void light_up(std::span<const Sighting> seen);

  [[nodiscard]] const Layer& layer(bool of_bodies) const { return of_bodies ? bodies_ : fixed_; }
  /// Light on the surface at a sighting; of corners that light_up() was told of.
  [[nodiscard]] Eigen::Vector3f light(const Sighting& sighting) const;
  /// How far the surface moves while the shutter is open.
  [[nodiscard]] Eigen::Vector3f travel(const Sighting& sighting) const;
  [[nodiscard]] const std::vector<Lamp>& lamps() const { return lamps_; }

 private:
  struct Extent {
    std::size_t first = 0;  ///< point
    std::size_t count = 0;
    Eigen::Vector3f centre = Eigen::Vector3f::Zero();
    float radius_m = 0.0F;
  };

  void measure(Extent& extent) const;
  /// Computes entry i of what is unknown, first on fixed parts, then on bodies.
  void light_unknown(std::size_t i);
  [[nodiscard]] Eigen::Vector3f light_on_fixed(std::size_t index) const;
  [[nodiscard]] Eigen::Vector3f light_on_body(std::size_t index) const;
  [[nodiscard]] float distance_to_bodies(const Eigen::Vector3f& position) const;

  Layer fixed_;
  Layer bodies_;
  std::vector<Lamp> lamps_;
  BakedLight baked_;
  BouncedLightField bounced_;
  std::vector<float> openness_;  ///< of each point of the bodies
  std::vector<Extent> extents_;  ///< of each body
  std::vector<Eigen::Vector3f> travel_;
  /// Light on the corners of one layer, for the present poses where `is_known`.
  struct CornerLight {
    std::vector<Eigen::Vector3f> light;
    std::vector<bool> is_known;
    std::vector<std::size_t> unknown;  ///< to be computed next
  };
  static void find_unknown(const Layer& layer,
                           std::span<const Sighting> seen,
                           bool of_bodies,
                           CornerLight& corners);

  CornerLight fixed_light_;
  CornerLight body_light_;
};

}  // namespace tsg::render
