#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/simulation/furniture/assembly.hpp"
#include "common/simulation/furniture/materials.hpp"
#include "common/simulation/furniture/pieces.hpp"

namespace tsg::simulation::pieces {
namespace {

using Eigen::Vector3f;

/// Five tapered arms, each with a twin castor.
void add_star_base(Assembly& parts, const render::Material& arm) {
  const render::Material rubber = materials::dark_plastic();
  for (int i = 0; i < 5; ++i) {
    const double yaw = 2.0 * std::numbers::pi * i / 5.0;
    const Vector3f out(static_cast<float>(std::cos(yaw)), static_cast<float>(std::sin(yaw)), 0.0F);
    const Vector3f across(-out.y(), out.x(), 0.0F);
    const Vector3f up = Vector3f::UnitZ();
    parts.add(render::make_tube({{0.03F * out + 0.115F * up, 0.03F * across, 0.025F * up},
                                 {0.16F * out + 0.1F * up, 0.024F * across, 0.018F * up},
                                 {0.3F * out + 0.075F * up, 0.018F * across, 0.012F * up}},
                                8, arm));
    const Vector3f hub = 0.285F * out + 0.03F * up;
    for (const float side : {-1.0F, 1.0F}) {
      parts.bar(hub + side * 0.008F * across, hub + side * 0.026F * across, 0.03F, rubber);
    }
    parts.bar(hub, hub + 0.045F * up, 0.01F, materials::chrome());
  }
}

void add_gas_lift(Assembly& parts, float seat_m) {
  parts.turned({{{0.032F, 0.09F}, {0.032F, 0.26F}}, {{0.032F, 0.26F}, {0.02F, 0.262F}}},
               Vector3f::Zero(), materials::dark_plastic(), 16);
  parts.bar({0.0F, 0.0F, 0.25F}, {0.0F, 0.0F, seat_m - 0.1F}, 0.018F, materials::chrome());
  parts.box({0.24F, 0.2F, 0.045F}, {0.0F, 0.0F, seat_m - 0.125F}, materials::dark_plastic());
  parts.bar({0.05F, 0.05F, seat_m - 0.1F}, {0.07F, 0.27F, seat_m - 0.11F}, 0.006F,
            materials::dark_plastic());
}

void add_armrests(Assembly& parts, float seat_m) {
  const render::Material plastic = materials::dark_plastic();
  for (const float side : {-1.0F, 1.0F}) {
    const float y = side * 0.285F;
    parts.pipe({{-0.02F, side * 0.15F, seat_m - 0.09F},
                {-0.02F, y, seat_m - 0.085F},
                {-0.01F, y + side * 0.01F, seat_m},
                {0.0F, y, seat_m + 0.19F}},
               0.014F, plastic);
    parts.cushion({0.25F, 0.07F, 0.03F}, placed({0.02F, y, seat_m + 0.185F}), 0.013F, plastic);
  }
}

/// The back's cushion, bent around the sitter: a rounded box whose sides come forward.
render::Mesh curved_back(const Vector3f& size_m, const render::Material& material) {
  render::Mesh back = render::make_rounded_box(size_m, 0.03F, material, 8);
  for (Vector3f& point : back.points) {
    const float across = 2.0F * point.y() / size_m.y();
    const float lumbar = (point.z() / size_m.z() - 0.3F) * 2.0F;
    point.x() += 0.045F * across * across + 0.03F * std::exp(-lumbar * lumbar);
  }
  return back;
}

FurnitureModel seat_of(const Assembly& parts, const Eigen::Vector3d& seat, double grip_m) {
  FurnitureModel model;
  model.class_name = "chair";
  model.mesh = parts.finished();
  model.top_m = seat.z();
  model.seat = Seat{seat};
  model.grip_height_m = grip_m;
  return model;
}

}  // namespace

FurnitureModel office_chair(Random& random) {
  const auto seat = static_cast<float>(random.uniform(0.45, 0.49));
  const paint::Colour colour = materials::upholstery_colour(random);
  const render::Material cover =
      random.chance(0.25) ? materials::leather(colour, random) : materials::fabric(colour, random);
  const render::Material base =
      random.chance(0.5) ? materials::chrome() : materials::dark_plastic();
  const auto back_height = static_cast<float>(random.uniform(0.5, 0.62));
  Assembly parts;
  add_star_base(parts, base);
  add_gas_lift(parts, seat);
  parts.cushion({0.48F, 0.5F, 0.085F}, placed({0.02F, 0.0F, seat - 0.085F}), 0.04F, cover);
  parts.box({0.4F, 0.42F, 0.012F}, {0.01F, 0.0F, seat - 0.092F}, materials::dark_plastic());
  parts.pipe({{-0.05F, 0.0F, seat - 0.11F},
              {-0.26F, 0.0F, seat - 0.1F},
              {-0.3F, 0.0F, seat},
              {-0.31F, 0.0F, seat + 0.35F}},
             0.022F, materials::dark_plastic());
  const SE3 T_chair_back = tilted({-0.265F, 0.0F, seat + 0.1F}, -0.14);
  parts.add(curved_back({0.06F, 0.46F, back_height}, cover), T_chair_back);
  parts.add(render::make_rounded_box({0.02F, 0.38F, back_height - 0.08F}, 0.009F,
                                     materials::dark_plastic()),
            tilted({-0.29F, 0.0F, seat + 0.13F}, -0.14));
  if (random.chance(0.75)) add_armrests(parts, seat);
  return seat_of(parts, {0.0, 0.0, seat}, seat + 0.45);
}

FurnitureModel wooden_chair(Random& random) {
  constexpr float kSeat = 0.455F;
  constexpr float kBack = 0.88F;
  const render::Material wood = materials::any_wood(random);
  Assembly parts;
  for (const float side : {-1.0F, 1.0F}) {
    const float y = side * 0.19F;
    parts.add(render::make_bar({0.19F, y * 1.05F, 0.0F}, {0.17F, y, kSeat - 0.02F}, 0.02F, wood));
    parts.pipe({{-0.24F, y * 1.05F, 0.0F}, {-0.19F, y, kSeat}, {-0.27F, y, kBack}}, 0.02F, wood);
    parts.bar({0.18F, y, 0.2F}, {-0.215F, y, 0.2F}, 0.011F, wood);
  }
  parts.bar({-0.015F, -0.19F, 0.2F}, {-0.015F, 0.19F, 0.2F}, 0.011F, wood);
  parts.cushion({0.43F, 0.45F, 0.03F}, placed({0.0F, 0.0F, kSeat - 0.03F}), 0.012F, wood);
  for (const float share : {0.45F, 0.7F, 0.95F}) {
    const float z = kSeat + share * (kBack - kSeat);
    const float x = -0.19F - 0.08F * share;
    parts.cushion({0.018F, 0.37F, 0.065F}, tilted({x, 0.0F, z - 0.04F}, -0.18), 0.008F, wood);
  }
  double top = kSeat;
  if (random.chance(0.5)) {
    const render::Material cloth = materials::fabric(paint::any_colour(random), random);
    parts.cushion({0.39F, 0.4F, 0.035F}, placed({0.0F, 0.0F, kSeat}), 0.016F, cloth);
    top += 0.035;
  }
  return seat_of(parts, {0.0, 0.0, top}, 0.85);
}

}  // namespace tsg::simulation::pieces
