#include "services/slam/lib/dynamic/static_features.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <opencv2/core.hpp>

#include "services/slam/lib/dynamic/depth_cells.hpp"
#include "services/slam/lib/synthetic_scene.hpp"

namespace tsg {
namespace {

/// Four features, told apart by their descriptors, on a surface one metre away.
std::shared_ptr<const Features> four_features() {
  auto features = std::make_shared<Features>();
  for (int i = 0; i < 4; ++i) {
    features->items.push_back({.pixel = {100.0F * static_cast<float>(i + 1), 240.0F},
                               .inverse_depth = i == 3 ? 0.0F : 1.0F});
    features->descriptors.push_back({static_cast<std::uint64_t>(i), 0, 0, 0});
  }
  features->grid = FeatureGrid(features->items, 640, 480);
  features->surface = {.columns = 106, .rows = 80, .inverse_depths = std::vector(106 * 80, 1.0F)};
  features->counts = {.detected = 4, .dynamic = 0, .potentially_dynamic = 0, .with_depth = 3};
  return features;
}

TEST(StaticFeatures, AreAllWhereNothingMoves) {
  const auto all = four_features();
  const StaticFeatures kept = keep_static(all, {}, synthetic::camera());
  EXPECT_EQ(kept.features, all);
  EXPECT_EQ(kept.new_index, (std::vector<int>{0, 1, 2, 3}));
  EXPECT_TRUE(kept.doubtful.empty());
}

TEST(StaticFeatures, KeepTheirOrderDescriptorsAndDoubts) {
  Judgement judgement;
  judgement.is_dynamic = {false, true, false, false};
  judgement.is_doubtful = {false, true, false, true};
  const StaticFeatures kept = keep_static(four_features(), judgement, synthetic::camera());
  EXPECT_EQ(kept.new_index, (std::vector<int>{0, -1, 1, 2}));
  EXPECT_EQ(kept.doubtful, (std::vector<bool>{false, false, true}));
  ASSERT_EQ(kept.features->size(), 3U);
  EXPECT_EQ(kept.features->descriptors[1][0], 2U);
  EXPECT_EQ(kept.features->items[1].pixel.x(), 300.0F);
  EXPECT_EQ(kept.features->counts.dynamic, 1);
  EXPECT_EQ(kept.features->counts.with_depth, 2);
  std::vector<int> near;
  kept.features->grid.for_each_near({300.0F, 240.0F}, 5.0F, [&](int i) { near.push_back(i); });
  EXPECT_EQ(near, std::vector<int>{1});
}

TEST(StaticFeatures, HaveNoSurfaceOnWhatMoves) {
  const auto all = four_features();
  Judgement judgement;
  judgement.is_dynamic.assign(4, false);
  judgement.dynamic_cells = cv::Mat::zeros(120, 160, CV_8UC1);
  judgement.dynamic_cells(cv::Rect(0, 0, 80, 120)) = 255.0;  // the left half
  const StaticFeatures kept = keep_static(all, judgement, synthetic::camera());
  EXPECT_EQ(kept.features->size(), 4U);
  const Surface& surface = kept.features->surface;
  EXPECT_EQ(surface.at(53, 40), 0.0F);  // pixel 318
  EXPECT_EQ(surface.at(54, 40), 1.0F);
  EXPECT_EQ(std::ranges::count(surface.inverse_depths, 0.0F), 54 * 80);
  EXPECT_EQ(std::ranges::count(all->surface.inverse_depths, 0.0F), 0);
}

}  // namespace
}  // namespace tsg
