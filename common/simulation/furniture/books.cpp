#include <algorithm>
#include <numbers>

#include "common/simulation/furniture/assembly.hpp"
#include "common/simulation/furniture/materials.hpp"
#include "common/simulation/furniture/pieces.hpp"

namespace tsg::simulation::pieces {
namespace {

using Eigen::Vector3f;

/// What books of one row have in common.
struct Covers {
  render::Material spines;  ///< the picture of all spines, see textures::book_spines
  std::vector<render::Material> boards;
  render::Material pages;
};

Covers make_covers(Random& random) {
  Covers covers;
  covers.spines = materials::pictured(textures::book_spines(random), 1.0, 0.12F);
  for (int i = 0; i < 6; ++i) covers.boards.push_back(materials::plain(paint::any_colour(random)));
  covers.pages = materials::plain({200, 218, 226}, 0.0F);
  return covers;
}

/// One book: the spine faces +x, standing on z = 0, centred in y.
render::Mesh make_book(const Vector3f& size_m, const Covers& covers, Random& random) {
  constexpr float kCover = 0.003F;
  const auto index =
      static_cast<std::size_t>(random.integer(0, static_cast<int>(covers.boards.size()) - 1));
  const render::Material& board = covers.boards.at(index);
  Assembly book;
  const Vector3f block(size_m.x() - 0.01F, std::max(size_m.y() - 2.0F * kCover, 0.004F),
                       size_m.z() - 0.01F);
  book.box(block, {0.0F, 0.0F, 0.005F}, covers.pages);
  for (const float side : {-1.0F, 1.0F}) {
    book.box({size_m.x(), kCover, size_m.z()}, {0.0F, side * 0.5F * (size_m.y() - kCover), 0.0F},
             board);
  }
  render::Mesh spine = render::make_picture(size_m.y(), size_m.z(), covers.spines);
  use_cell(spine, random.integer(0, textures::kSpineColumns * textures::kSpineRows - 1),
           textures::kSpineColumns, textures::kSpineRows);
  book.add(spine, placed({0.5F * size_m.x() + 0.001F, 0.0F, 0.0F}));
  return book.finished();
}

Vector3f any_book_size(double highest_m, Random& random) {
  const double height = std::min(random.uniform(0.19, 0.3), highest_m);
  return {static_cast<float>(0.7 * height), static_cast<float>(random.uniform(0.016, 0.052)),
          static_cast<float>(height)};
}

/// A few books lying one on the other, spines to the front; returns the width they take.
float add_pile(Assembly& parts, const Vector3f& at, const Covers& covers, Random& random) {
  float z = at.z();
  const int count = random.integer(3, 5);
  for (int i = 0; i < count; ++i) {
    const Vector3f size = any_book_size(0.23, random);
    const Eigen::Quaterniond lying(
        Eigen::AngleAxisd(0.5 * std::numbers::pi, Eigen::Vector3d::UnitX()));
    const Eigen::Vector3d corner(at.x(), at.y() + 0.5 * size.z() + 0.125, z + 0.5 * size.y());
    parts.add(make_book(size, covers, random), SE3(lying, corner));
    z += size.y();
  }
  return 0.26F;
}

/// Books side by side from `from` (the left end of the front edge of a board) over `width_m`.
void add_books(Assembly& parts,
               const Vector3f& from,
               const Eigen::Vector2f& space_m,
               const Covers& covers,
               Random& random) {
  const float end = from.y() + space_m.x();
  float y = from.y();
  while (true) {
    if (random.chance(0.05) && end - y > 0.35F) {
      y += add_pile(parts, {from.x() - 0.1F, y, from.z()}, covers, random);
      continue;
    }
    const Vector3f size = any_book_size(space_m.y() - 0.02, random);
    if (y + size.y() > end) break;
    const float depth = from.x() - 0.5F * size.x() - static_cast<float>(random.uniform(0.0, 0.03));
    parts.add(make_book(size, covers, random), placed({depth, y + 0.5F * size.y(), from.z()}));
    y += size.y() + 0.001F;
    if (random.chance(0.04)) y += static_cast<float>(random.uniform(0.02, 0.07));
  }
}

/// A storage box or a folder stand instead of books.
void add_storage_box(Assembly& parts, const Vector3f& at, Random& random) {
  const render::Material card =
      materials::pictured(textures::label(materials::upholstery_colour(random), random), 0.26);
  parts.cushion({0.26F, 0.24F, 0.2F}, placed(at), 0.008F, card);
}

struct Carcass {
  float depth_m = 0.3F;
  float width_m = 0.9F;
  float height_m = 1.95F;
  int boards = 6;
};

constexpr float kBoard = 0.02F;

float board_height(const Carcass& carcass, int board) {
  const float pitch = (carcass.height_m - 0.06F - kBoard) / static_cast<float>(carcass.boards - 1);
  return 0.06F + pitch * static_cast<float>(board);
}

void add_carcass(Assembly& parts, const Carcass& carcass, const render::Material& wood) {
  const float inner = carcass.width_m - 2.0F * kBoard;
  for (const float side : {-1.0F, 1.0F}) {
    parts.box({carcass.depth_m, kBoard, carcass.height_m},
              {0.0F, side * 0.5F * (carcass.width_m - kBoard), 0.0F}, wood);
  }
  for (int board = 0; board < carcass.boards; ++board) {
    parts.box({carcass.depth_m - 0.008F, inner, kBoard},
              {-0.002F, 0.0F, board_height(carcass, board)}, wood);
  }
  parts.box({0.006F, inner, carcass.height_m - 0.08F},
            {-0.5F * carcass.depth_m + 0.006F, 0.0F, 0.07F}, wood);
  parts.box({0.015F, inner, 0.058F}, {0.5F * carcass.depth_m - 0.03F, 0.0F, 0.0F}, wood);
}

}  // namespace

FurnitureModel bookshelf(Random& random) {
  Carcass carcass;
  carcass.width_m = static_cast<float>(random.uniform(0.8, 1.0));
  carcass.height_m = static_cast<float>(random.uniform(1.8, 2.05));
  const Covers covers = make_covers(random);
  const float inner = carcass.width_m - 2.0F * kBoard;
  const float gap = board_height(carcass, 1) - board_height(carcass, 0) - kBoard;
  Assembly parts;
  add_carcass(parts, carcass, materials::any_wood(random));
  for (int board = 0; board + 1 < carcass.boards; ++board) {
    const Vector3f from(0.5F * carcass.depth_m - 0.03F, -0.5F * inner + 0.004F,
                        board_height(carcass, board) + kBoard);
    const float boxed = random.chance(0.25) ? 0.27F : 0.0F;
    add_books(parts, from, {inner - 0.01F - boxed, gap}, covers, random);
    if (boxed > 0.0F) {
      add_storage_box(parts, {0.0F, 0.5F * inner - 0.135F, from.z()}, random);
    }
  }
  FurnitureModel model;
  model.class_name = "bookshelf";
  model.mesh = parts.finished();
  model.top_m = board_height(carcass, carcass.boards - 1) + kBoard;
  return model;
}

FurnitureModel book_row(Random& random) {
  const auto width = static_cast<float>(random.uniform(0.4, 0.6));
  Assembly parts;
  add_books(parts, {0.1F, -0.5F * width, 0.0F}, {width, 0.32F}, make_covers(random), random);
  FurnitureModel model;
  model.class_name = "book";
  model.mesh = parts.finished();
  return model;
}

FurnitureModel book_stack(Random& random) {
  const Covers covers = make_covers(random);
  Assembly parts;
  float z = 0.0F;
  const int count = random.integer(3, 7);
  for (int i = 0; i < count; ++i) {
    const Vector3f size = any_book_size(0.3, random);
    const Eigen::Quaterniond lying(
        Eigen::AngleAxisd(0.5 * std::numbers::pi, Eigen::Vector3d::UnitX()));
    const Eigen::Quaterniond turned(
        Eigen::AngleAxisd(random.uniform(-0.3, 0.3), Eigen::Vector3d::UnitZ()));
    const SE3 T_stack_book(turned, Eigen::Vector3d(0.0, 0.0, z + 0.5 * size.y()));
    parts.add(make_book(size, covers, random),
              T_stack_book * SE3(lying, Eigen::Vector3d(0.0, 0.5 * size.z(), 0.0)));
    z += size.y();
  }
  FurnitureModel model;
  model.class_name = "book";
  model.mesh = parts.finished();
  model.top_m = z;
  return model;
}

}  // namespace tsg::simulation::pieces
