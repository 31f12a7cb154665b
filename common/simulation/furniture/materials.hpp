#pragma once

#include <opencv2/core/mat.hpp>

#include "common/render/mesh.hpp"
#include "common/simulation/furniture/paint.hpp"
#include "common/simulation/furniture/textures.hpp"

/// What furniture is made of.
namespace tsg::simulation::materials {

using paint::Colour;
using render::Material;

/// Plain, with the strength of its highlights (0..1).
[[nodiscard]] Material plain(const Colour& colour, float gloss = 0.1F);
/// `picture` wrapped around; one picture covers `size_m` of a shape whose uv is in metres, and all
/// of a shape whose uv runs 0..1 where `size_m` is 1.
[[nodiscard]] Material pictured(const cv::Mat& picture, double size_m = 1.0, float gloss = 0.05F);

[[nodiscard]] Material wood(textures::Wood kind, Random& random);
[[nodiscard]] Material any_wood(Random& random);
/// Cloth of a colour, or with a pattern.
[[nodiscard]] Material fabric(const Colour& colour, Random& random);
[[nodiscard]] Material leather(const Colour& colour, Random& random);
[[nodiscard]] Material metal(const Colour& colour, Random& random);
[[nodiscard]] Material chrome();
[[nodiscard]] Material dark_plastic();
/// A screen that is on. An infrared sensor sees it: only black glass swallows its light.
[[nodiscard]] Material lit_screen(const cv::Mat& picture);
/// Black glass, which returns no depth.
[[nodiscard]] Material black_glass();
/// Something that shines; 1 = as bright as a well-lit white wall.
[[nodiscard]] Material glowing(const Colour& colour, float emission);

/// Of a cloth or a shell in an office: mostly dark and greyish, sometimes bright.
[[nodiscard]] Colour upholstery_colour(Random& random);

}  // namespace tsg::simulation::materials
