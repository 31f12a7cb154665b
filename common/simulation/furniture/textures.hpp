#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

#include "common/simulation/furniture/paint.hpp"

/// Pictures for surfaces and things, made by seeded noise: CV_8UC3, BGR, sides powers of two. Those
/// of surfaces repeat without a seam. "Along v": down the picture.
namespace tsg::simulation::textures {

using paint::Colour;

// textures_wood.cpp
enum class Wood { kBirch, kOak, kBeech, kWalnut, kWhite };
[[nodiscard]] Wood any_wood(Random& random);
/// Grain along v; meant for 1 m.
[[nodiscard]] cv::Mat wood(Wood kind, Random& random);
/// Boards along v, 16 across, staggered; meant for 2 m.
[[nodiscard]] cv::Mat planks(Wood kind, Random& random);
/// Blocks laid like a basket's weave; meant for 2 m.
[[nodiscard]] cv::Mat parquet(Wood kind, Random& random);

// textures_surface.cpp: floors, walls and ceilings
[[nodiscard]] cv::Mat carpet(const Colour& colour, Random& random);         ///< 2 m
[[nodiscard]] cv::Mat carpet_tiles(const Colour& colour, Random& random);   ///< 2 m, 4 x 4 tiles
[[nodiscard]] cv::Mat linoleum(const Colour& colour, Random& random);       ///< 2 m
[[nodiscard]] cv::Mat ceramic_tiles(const Colour& colour, Random& random);  ///< 8 x 8 tiles
[[nodiscard]] cv::Mat plaster(const Colour& colour, Random& random);        ///< 4 m
[[nodiscard]] cv::Mat wallpaper(const Colour& colour, Random& random);      ///< 1 m
[[nodiscard]] cv::Mat brick(const Colour& colour, Random& random);          ///< 2 m
[[nodiscard]] cv::Mat concrete(const Colour& colour, Random& random);       ///< 4 m
[[nodiscard]] cv::Mat ceiling_tiles(Random& random);                        ///< 2.4 m, 4 x 4 tiles

// textures_fabric.cpp
[[nodiscard]] cv::Mat weave(const Colour& colour, Random& random);  ///< 0.3 m
[[nodiscard]] cv::Mat patterned(const Colour& colour,
                                Random& random);                      ///< 0.5 m: stripes, checks...
[[nodiscard]] cv::Mat leather(const Colour& colour, Random& random);  ///< 0.5 m
[[nodiscard]] cv::Mat rug(Random& random);                            ///< the whole rug
[[nodiscard]] cv::Mat brushed_metal(const Colour& colour, Random& random);  ///< 0.5 m
[[nodiscard]] cv::Mat cardboard(Random& random);                            ///< one side of a box
[[nodiscard]] cv::Mat bark(Random& random);                                 ///< 0.5 m
[[nodiscard]] cv::Mat leaf(const Colour& colour,
                           Random& random);  ///< one leaf, stalk at the bottom
[[nodiscard]] cv::Mat soil(Random& random);  ///< 0.3 m

// textures_print.cpp
/// A poster of one of several layouts: landscape, typographic, charts, map, abstract.
[[nodiscard]] cv::Mat poster(Random& random);
/// Sky, trees and houses, as seen through a window.
[[nodiscard]] cv::Mat outside(Random& random);
[[nodiscard]] cv::Mat landscape(const cv::Size& size, Random& random);

// textures_office.cpp
/// 16 x 2 spines of books, each kSpineWidth x kSpineHeight.
[[nodiscard]] cv::Mat book_spines(Random& random);
inline constexpr int kSpineColumns = 16;
inline constexpr int kSpineRows = 2;
[[nodiscard]] cv::Mat written_board(Random& random);  ///< a whiteboard's whole face
[[nodiscard]] cv::Mat pinned_papers(Random& random);  ///< a notice board's whole face
[[nodiscard]] cv::Mat newspaper(Random& random);      ///< a page
[[nodiscard]] cv::Mat clock_face(Random& random);
[[nodiscard]] cv::Mat label(const Colour& colour, Random& random);  ///< a label, a mug's print

// textures_screen.cpp
/// What a screen shows: code, a web page, a spreadsheet, a desktop.
[[nodiscard]] cv::Mat screen(Random& random);
/// Keys of a keyboard, seen from above.
[[nodiscard]] cv::Mat key_caps(Random& random);

}  // namespace tsg::simulation::textures
