#pragma once

#include <Eigen/Core>
#include <vector>

#include "common/render/mesh.hpp"

namespace tsg::render {

/// Shapes of one material each. uv is in metres on faces (for textures that repeat), unless a shape
/// says that it runs 0..1.

/// A box centred in x and y that stands on z = 0.
[[nodiscard]] Mesh make_box(const Eigen::Vector3f& size_m, const Material& material);

/// The same with rounded edges (cushions, housings). `flat_steps`: into how many parts the flat
/// middle of each face is cut, for who bends it further.
[[nodiscard]] Mesh make_rounded_box(const Eigen::Vector3f& size_m,
                                    float radius_m,
                                    const Material& material,
                                    int flat_steps = 1);

/// An upright rectangle in the y-z plane that faces +x, centred on y = 0, standing on z = 0; uv
/// runs 0..1 with v down: pictures, screens.
[[nodiscard]] Mesh make_picture(float width_m, float height_m, const Material& material);

/// A round face in the x-y plane that faces +z, centred on the origin; uv in metres.
[[nodiscard]] Mesh make_disc(float radius_m, int sides, const Material& material);

/// One point of an outline: radius from the z axis at a height.
struct OutlinePoint {
  float radius_m = 0.0F;
  float z_m = 0.0F;
};

/// The outline, from bottom to top, turned about the z axis: cups, vases, lamps, posts.
[[nodiscard]] Mesh make_turned(const std::vector<OutlinePoint>& outline,
                               int sides,
                               const Material& material);

/// One ring of a tube: an ellipse around `centre`, with its two half axes.
struct TubeRing {
  Eigen::Vector3f centre;
  Eigen::Vector3f half_axis_a;
  Eigen::Vector3f half_axis_b;  ///< direction of the tube = a x b
};

/// A closed tube through the rings: limbs, trunks, cables. uv: u once around (0..1), v in metres
/// along it.
[[nodiscard]] Mesh make_tube(const std::vector<TubeRing>& rings,
                             int sides,
                             const Material& material);

/// A round bar from `from` to `to`.
[[nodiscard]] Mesh make_bar(const Eigen::Vector3f& from,
                            const Eigen::Vector3f& to,
                            float radius_m,
                            const Material& material);

}  // namespace tsg::render
