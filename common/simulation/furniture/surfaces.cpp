#include "common/simulation/furniture/surfaces.hpp"

#include <algorithm>
#include <array>
#include <string_view>

#include "common/core/check.hpp"
#include "common/simulation/furniture/materials.hpp"
#include "common/simulation/furniture/room.hpp"
#include "common/simulation/furniture/textures.hpp"

namespace tsg::simulation {
namespace {

using paint::Colour;

struct Surface {
  std::string_view name;
  cv::Mat (*picture)(const Colour&, Random&);
  double size_m;  ///< that one picture covers
  std::array<double, 3> colour_bgr;
  float gloss;
};

cv::Mat oak_planks(const Colour& /*colour*/, Random& random) {
  return textures::planks(textures::Wood::kOak, random);
}

cv::Mat beech_planks(const Colour& /*colour*/, Random& random) {
  return textures::planks(textures::Wood::kBeech, random);
}

cv::Mat oak_parquet(const Colour& /*colour*/, Random& random) {
  return textures::parquet(textures::Wood::kOak, random);
}

cv::Mat walnut_planks(const Colour& /*colour*/, Random& random) {
  return textures::planks(textures::Wood::kWalnut, random);
}

/// Sorted by name. Those of wood have the wood's colour unless a room asks for one.
constexpr std::array kSurfaces = {
    Surface{"brick", &textures::brick, 2.0, {62, 84, 150}, 0.0F},
    Surface{"carpet", &textures::carpet, 2.0, {112, 100, 92}, 0.0F},
    Surface{"carpet_tiles", &textures::carpet_tiles, 2.0, {104, 92, 84}, 0.0F},
    Surface{"concrete", &textures::concrete, 4.0, {150, 156, 158}, 0.1F},
    Surface{"laminate", &beech_planks, 2.0, {108, 152, 198}, 0.25F},
    Surface{"linoleum", &textures::linoleum, 2.0, {128, 142, 140}, 0.25F},
    Surface{"parquet", &oak_parquet, 2.0, {90, 136, 175}, 0.3F},
    Surface{"planks", &oak_planks, 2.0, {90, 136, 175}, 0.2F},
    Surface{"plaster", &textures::plaster, 4.0, {214, 222, 226}, 0.0F},
    Surface{"tiles", &textures::ceramic_tiles, 1.6, {196, 206, 208}, 0.4F},
    Surface{"wallpaper", &textures::wallpaper, 1.0, {178, 206, 216}, 0.0F},
    Surface{"wood_panels", &walnut_planks, 2.0, {48, 70, 98}, 0.25F},
};

}  // namespace

render::Material make_surface(const std::string& name,
                              const std::optional<Colour>& colour,
                              std::uint64_t seed) {
  const auto* const surface = std::find_if(kSurfaces.begin(), kSurfaces.end(),
                                           [&](const Surface& each) { return each.name == name; });
  TSG_CHECK(surface != kSurfaces.end());
  const auto& own = surface->colour_bgr;
  Random random(seed_of(seed, name));
  const cv::Mat picture = surface->picture(colour.value_or(Colour(own[0], own[1], own[2])), random);
  return materials::pictured(picture, surface->size_m, surface->gloss);
}

std::vector<std::string> surface_names() {
  std::vector<std::string> names;
  names.reserve(kSurfaces.size());
  for (const Surface& surface : kSurfaces) names.emplace_back(surface.name);
  return names;
}

}  // namespace tsg::simulation
