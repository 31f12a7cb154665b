#include "services/slam/lib/dynamic/motion_evidence.hpp"

#include <gtest/gtest.h>

namespace tsg {
namespace {

constexpr MotionCounts kPushed{.features_moved = 12, .features_still = 3};
constexpr MotionCounts kAtRest{.features_still = 15, .cells_same = 200};

void add(MotionEvidence& evidence, const MotionCounts& counts, int frames) {
  for (int i = 0; i < frames; ++i) evidence.add(counts);
}

TEST(MotionEvidence, BelievesAPushWithinTwoFramesHoweverLongItStoodBefore) {
  MotionEvidence evidence;
  add(evidence, kAtRest, 1000);
  EXPECT_FALSE(evidence.is_moving());
  EXPECT_LT(evidence.probability(), 0.3);
  add(evidence, kPushed, 2);
  EXPECT_TRUE(evidence.is_moving());
  EXPECT_GT(evidence.probability(), 0.7);
}

TEST(MotionEvidence, BelievesInRestAfterAboutASecond) {
  MotionEvidence evidence;
  add(evidence, kPushed, 100);
  add(evidence, kAtRest, 20);
  EXPECT_TRUE(evidence.is_moving());
  add(evidence, kAtRest, 20);
  EXPECT_FALSE(evidence.is_moving());
}

TEST(MotionEvidence, CellsAloneTellOfMotion) {
  MotionEvidence evidence;
  add(evidence, {.cells_appeared = 30, .cells_same = 70}, 2);
  EXPECT_TRUE(evidence.is_moving());
}

TEST(MotionEvidence, FewFeaturesAndCellsSayNothing) {
  MotionEvidence evidence;
  const double before = evidence.probability();
  add(evidence, {.features_moved = 4, .cells_appeared = 29}, 100);
  EXPECT_EQ(evidence.probability(), before);
  EXPECT_FALSE(evidence.is_moving());
}

TEST(MotionEvidence, RemembersThatItWasCertain) {
  MotionEvidence evidence;
  add(evidence, kPushed, 1);
  EXPECT_FALSE(evidence.was_certain());
  add(evidence, kPushed, 4);
  EXPECT_TRUE(evidence.was_certain());
  add(evidence, kAtRest, 100);
  EXPECT_FALSE(evidence.is_moving());
  EXPECT_TRUE(evidence.was_certain());
}

}  // namespace
}  // namespace tsg
