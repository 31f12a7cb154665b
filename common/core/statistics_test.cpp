#include "common/core/statistics.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace tsg {
namespace {

TEST(Summarise, OfNothingIsAllZero) {
  const Summary summary = summarise({});
  EXPECT_EQ(summary.count, 0U);
  EXPECT_EQ(summary.rmse, 0.0);
}

TEST(Summarise, AgreesWithFiguresWorkedOutByHand) {
  const Summary summary = summarise({4.0, 1.0, 3.0, 2.0});
  EXPECT_EQ(summary.count, 4U);
  EXPECT_DOUBLE_EQ(summary.mean, 2.5);
  EXPECT_DOUBLE_EQ(summary.median, 2.5);
  EXPECT_DOUBLE_EQ(summary.rmse, std::sqrt(30.0 / 4.0));
  EXPECT_DOUBLE_EQ(summary.std_dev, std::sqrt(1.25));
  EXPECT_DOUBLE_EQ(summary.min, 1.0);
  EXPECT_DOUBLE_EQ(summary.max, 4.0);
  EXPECT_NEAR(summary.p99, 3.97, 1e-12);
}

TEST(Quantile, OfOneValueIsThatValue) { EXPECT_DOUBLE_EQ(quantile({7.0}, 0.99), 7.0); }

}  // namespace
}  // namespace tsg
