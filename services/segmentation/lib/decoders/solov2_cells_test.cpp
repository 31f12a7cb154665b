#include "services/segmentation/lib/decoders/solov2_cells.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <vector>

namespace tsg {
namespace {

using testing::ElementsAre;

/// Cells of one grid of 3 x 3 and one class in which a candidate is found.
std::vector<int> cells_found(const std::array<float, 9>& values, bool is_merged) {
  Solov2Layout layout;
  layout.is_merged = is_merged;
  layout.class_names = {"person"};
  const std::vector<Solov2Level> levels{{.categories = values.data(),
                                         .size = 3,
                                         .stride = 8,
                                         .between_cells_of_categories = 1,
                                         .between_classes = 9}};
  std::vector<int> cells;
  for (const Solov2Candidate& candidate : find_candidates(layout, levels)) {
    cells.push_back(candidate.cell);
  }
  return cells;
}

TEST(Solov2Candidates, AreThoseThatNoCellLeftOrAboveBeats) {
  EXPECT_THAT(cells_found({3, 2, -9,  //
                           2, 1, -9,  //
                           -9, -9, 4},
                          false),
              ElementsAre(0, 8));
  EXPECT_THAT(cells_found({1, 2, 3,     // each beats the one before it, which SOLOv2 leaves alone
                           -9, -9, -9,  //
                           -9, -9, -9},
                          false),
              ElementsAre(0, 1, 2));
  EXPECT_THAT(cells_found({-9, -9, -9,  //
                           2, -9, -9,   // equals stay
                           2, -9, -9},
                          false),
              ElementsAre(3, 6));
}

TEST(Solov2Candidates, ScoreAboveOneTenth) {
  EXPECT_THAT(cells_found({-9, -9, -9, -2.19F, -9, -9, -9, -9, -2.2F}, false), ElementsAre(3));
  EXPECT_THAT(cells_found({0, 0.1F, 0.11F, 0, 0, 0, 0, 0, 0.9F}, true), ElementsAre(2, 8));
}

TEST(Solov2Candidates, OfMergedOutputsHavePointsNmsBehindThem) {
  EXPECT_THAT(cells_found({0.9F, 0.8F, 0, 0, 0, 0, 0, 0, 0}, true), ElementsAre(0, 1));
}

}  // namespace
}  // namespace tsg
