#include "common/simulation/furniture/assembly.hpp"
#include "common/simulation/furniture/materials.hpp"
#include "common/simulation/furniture/pieces.hpp"

namespace tsg::simulation::pieces {
namespace {

using Eigen::Vector3f;

/// A housing of `depth_m` with a picture on its front, whose bottom centre of the back is at the
/// origin; `bezel_m` is left free around the picture.
void add_panel(Assembly& parts,
               const Vector3f& size_m,
               float bezel_m,
               const render::Material& screen,
               const SE3& T_model_panel) {
  const render::Material housing = materials::plain({28, 27, 26}, 0.35F);
  const float front = size_m.x();
  Assembly panel;
  panel.cushion(size_m, placed({0.5F * front, 0.0F, 0.0F}), 0.006F, housing);
  panel.add(render::make_picture(size_m.y() - 2.0F * bezel_m, size_m.z() - 2.2F * bezel_m, screen),
            placed({front + 0.0015F, 0.0F, 1.2F * bezel_m}));
  parts.add(panel.finished(), T_model_panel);
}

render::Material any_screen(Random& random) {
  if (random.chance(0.12)) return materials::black_glass();
  return materials::lit_screen(textures::screen(random));
}

}  // namespace

FurnitureModel monitor(Random& random) {
  const auto width = static_cast<float>(random.uniform(0.52, 0.64));
  const float height = 0.57F * width;
  const auto lift = static_cast<float>(random.uniform(0.11, 0.16));
  const bool is_silver = random.chance(0.3);
  const render::Material stand =
      is_silver ? materials::plain({185, 186, 188}, 0.5F) : materials::dark_plastic();
  Assembly parts;
  parts.cushion({0.2F, 0.26F, 0.014F}, placed({-0.02F, 0.0F, 0.0F}), 0.006F, stand);
  parts.add(render::make_rounded_box({0.025F, 0.07F, lift + 0.14F}, 0.01F, stand),
            tilted({-0.07F, 0.0F, 0.01F}, 0.1));
  parts.box({0.04F, 0.1F, 0.1F}, {-0.035F, 0.0F, lift + 0.5F * height - 0.05F}, stand);
  add_panel(parts, {0.032F, width, height}, 0.012F, any_screen(random),
            tilted({-0.012F, 0.0F, lift}, -0.05));
  FurnitureModel model;
  model.class_name = "tv";
  model.mesh = parts.finished();
  return model;
}

FurnitureModel wall_tv(Random& random) {
  const auto width = static_cast<float>(random.uniform(1.1, 1.4));
  const float height = 0.57F * width;
  Assembly parts;
  parts.box({0.04F, 0.4F, 0.3F}, {0.02F, 0.0F, 0.5F * height - 0.15F}, materials::dark_plastic());
  add_panel(parts, {0.045F, width, height}, 0.018F, any_screen(random),
            placed({0.035F, 0.0F, 0.0F}));
  FurnitureModel model;
  model.class_name = "tv";
  model.mesh = parts.finished();
  return model;
}

FurnitureModel laptop(Random& random) {
  const auto width = static_cast<float>(random.uniform(0.31, 0.36));
  const float depth = 0.68F * width;
  const render::Material body = random.chance(0.5) ? materials::plain({186, 184, 182}, 0.4F)
                                                   : materials::plain({48, 46, 44}, 0.3F);
  const render::Material keys = materials::pictured(textures::key_caps(random), 0.076);
  Assembly parts;
  parts.cushion({depth, width, 0.016F}, placed(Vector3f::Zero()), 0.005F, body);
  constexpr float kKey = 0.019F;
  const int columns = static_cast<int>((width - 0.03F) / kKey);
  for (int i = 0; i < 5 * columns; ++i) {
    const int row = i / columns;
    const float x = -0.35F * depth + kKey * static_cast<float>(row);
    const float y =
        kKey * (static_cast<float>(i % columns) - 0.5F * static_cast<float>(columns - 1));
    parts.box({0.016F, 0.016F, 0.002F}, {x, y, 0.016F}, keys);
  }
  parts.box({0.06F, 0.1F, 0.0012F}, {0.32F * depth, 0.0F, 0.016F},
            materials::plain({120, 120, 122}));
  add_panel(parts, {0.007F, width, depth}, 0.008F, any_screen(random),
            tilted({-0.5F * depth + 0.002F, 0.0F, 0.014F}, -0.3));
  FurnitureModel model;
  model.class_name = "laptop";
  model.mesh = parts.finished();
  return model;
}

}  // namespace tsg::simulation::pieces
