#pragma once

#include <Eigen/Core>
#include <vector>

#include "common/geometry/se3.hpp"
#include "common/render/mesh.hpp"
#include "common/render/shapes.hpp"

namespace tsg::simulation {

/// `at`, turned by `yaw_rad` about z.
[[nodiscard]] SE3 placed(const Eigen::Vector3f& at, double yaw_rad = 0.0);
/// `at`, first turned by `pitch_rad` about y (positive: the front goes down), then by `yaw_rad`.
[[nodiscard]] SE3 tilted(const Eigen::Vector3f& at, double pitch_rad, double yaw_rad = 0.0);

/// Puts a model together from shapes.
class Assembly {
 public:
  void add(const render::Mesh& part, const SE3& T_model_part = {});
  /// A box whose bottom centre is `at`.
  void box(const Eigen::Vector3f& size_m,
           const Eigen::Vector3f& at,
           const render::Material& material,
           double yaw_rad = 0.0);
  /// The same with rounded edges of `radius_m`; see render::make_rounded_box.
  void cushion(const Eigen::Vector3f& size_m,
               const SE3& T_model_part,
               float radius_m,
               const render::Material& material);
  void bar(const Eigen::Vector3f& from,
           const Eigen::Vector3f& to,
           float radius_m,
           const render::Material& material);
  /// Bars through `points` one after the other, with rounded joints.
  void pipe(const std::vector<Eigen::Vector3f>& points,
            float radius_m,
            const render::Material& material);
  /// A turned body with crisp edges: each part of the outline is smooth in itself.
  void turned(const std::vector<std::vector<render::OutlinePoint>>& outlines,
              const Eigen::Vector3f& at,
              const render::Material& material,
              int sides = 20);

  /// The model, with each material once.
  [[nodiscard]] render::Mesh finished() const;

 private:
  render::Mesh mesh_;
};

/// A face of a `columns` x `rows` picture: moves the uvs 0..1 of `part` into cell `index`.
void use_cell(render::Mesh& part, int index, int columns, int rows);

}  // namespace tsg::simulation
