#include "common/simulation/furniture/assembly.hpp"
#include "common/simulation/furniture/materials.hpp"
#include "common/simulation/furniture/pieces.hpp"

namespace tsg::simulation::pieces {
namespace {

using Eigen::Vector3f;

constexpr float kSeat = 0.43F;
constexpr float kArm = 0.17F;         // width of an armrest
constexpr float kCouchDepth = 0.85F;  // front to back

/// An upholstered seat for `places`, each with a cushion to sit on and one to lean on.
Assembly upholstered(int places, float place_m, const render::Material& cover, Random& random) {
  const float inner = place_m * static_cast<float>(places);
  const float width = inner + 2.0F * kArm;
  const render::Material leg = materials::any_wood(random);
  Assembly parts;
  parts.cushion({kCouchDepth - 0.06F, width - 0.04F, 0.22F}, placed({0.0F, 0.0F, 0.08F}), 0.03F,
                cover);
  parts.cushion({0.2F, width - 0.02F, 0.62F}, tilted({-0.31F, 0.0F, 0.12F}, -0.1), 0.07F, cover);
  for (const float side : {-1.0F, 1.0F}) {
    parts.cushion({kCouchDepth - 0.05F, kArm, 0.5F},
                  placed({0.0F, side * 0.5F * (inner + kArm), 0.09F}), 0.06F, cover);
    for (const float x : {-0.34F, 0.34F}) {
      parts.bar({x, side * (0.5F * width - 0.09F), 0.0F}, {x, side * (0.5F * width - 0.1F), 0.1F},
                0.022F, leg);
    }
  }
  for (int i = 0; i < places; ++i) {
    const float y = place_m * (static_cast<float>(i) + 0.5F) - 0.5F * inner;
    parts.cushion({0.62F, place_m - 0.012F, 0.16F}, placed({0.1F, y, kSeat - 0.16F}), 0.05F, cover);
    parts.cushion({0.15F, place_m - 0.03F, 0.42F}, tilted({-0.16F, y, kSeat - 0.02F}, -0.22),
                  0.065F, cover);
  }
  return parts;
}

render::Material any_cover(Random& random) {
  const paint::Colour colour = materials::upholstery_colour(random);
  return random.chance(0.3) ? materials::leather(colour, random)
                            : materials::fabric(colour, random);
}

/// A loose pillow that leans in a corner.
void add_pillow(Assembly& parts, float y, Random& random) {
  const render::Material cloth =
      materials::pictured(textures::patterned(paint::any_colour(random), random), 0.3, 0.0F);
  parts.cushion({0.12F, 0.4F, 0.38F},
                tilted({0.0F, y, kSeat - 0.005F}, -0.35, random.uniform(-0.3, 0.3)), 0.058F, cloth);
}

FurnitureModel seat_of(const std::string& class_name, const Assembly& parts) {
  FurnitureModel model;
  model.class_name = class_name;
  model.mesh = parts.finished();
  model.top_m = kSeat;
  model.seat = Seat{{0.12, 0.0, kSeat}};
  model.grip_height_m = 0.7;
  return model;
}

}  // namespace

FurnitureModel armchair(Random& random) {
  Assembly parts = upholstered(1, 0.58F, any_cover(random), random);
  return seat_of("chair", parts);
}

FurnitureModel couch(Random& random) {
  const int places = random.integer(2, 3);
  constexpr float kPlace = 0.64F;
  Assembly parts = upholstered(places, kPlace, any_cover(random), random);
  const float corner = 0.5F * kPlace * static_cast<float>(places) - 0.2F;
  add_pillow(parts, corner, random);
  if (random.chance(0.6)) add_pillow(parts, -corner, random);
  FurnitureModel model = seat_of("couch", parts);
  // An even number of places has none in the middle.
  if (places == 2) model.seat->centre_m.y() = -0.5 * kPlace;
  return model;
}

}  // namespace tsg::simulation::pieces
