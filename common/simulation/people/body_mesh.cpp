#include "common/simulation/people/body_mesh.hpp"

#include <memory>
#include <utility>

#include "common/simulation/people/body_textures.hpp"
#include "common/simulation/people/loft.hpp"

namespace tsg::simulation {
namespace {

render::Material textured(const cv::Mat& image, float gloss) {
  render::Material material;
  material.texture = std::make_shared<const render::Texture>(image);
  material.gloss = gloss;
  return material;
}

std::vector<render::Material> make_materials(const Look& look) {
  const render::Material bottom = textured(paint_bottom(look), 0.0F);
  // In the order of BodyMaterial.
  return {textured(paint_skin(look), 0.04F),
          textured(paint_face(look), 0.04F),
          textured(paint_hair(look), 0.03F),
          textured(paint_top(look), 0.0F),
          textured(paint_cloth(look.top_cloth, {0.34, kSleeveTextureM}), 0.0F),
          bottom,
          look.bottom == Bottom::kSkirt ? textured(paint_tights(look), 0.02F) : bottom,
          textured(paint_shoe(look), 0.12F)};
}

}  // namespace

SkinnedMesh make_body(const Skeleton& skeleton, const Look& look) {
  SkinnedMesh mesh;
  mesh.rest.materials = make_materials(look);
  add_trunk(skeleton, look, mesh);
  for (const Side side : kBothSides) {
    add_leg(skeleton, look, side, mesh);
    add_shoe(skeleton, side, mesh);
    add_arm(skeleton, look, side, mesh);
    add_hand(skeleton, side, mesh);
  }
  add_head(skeleton, look, mesh);
  finish_normals(mesh);
  return mesh;
}

}  // namespace tsg::simulation
