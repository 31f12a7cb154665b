#include "common/core/sample_window.hpp"

#include <gtest/gtest.h>

namespace tsg {
namespace {

TEST(SampleWindow, ForgetsTheOldestOnceItIsFull) {
  SampleWindow window(3);
  for (const double value : {100.0, 1.0, 2.0, 3.0}) window.add(value);
  EXPECT_EQ(window.size(), 3U);
  EXPECT_DOUBLE_EQ(window.summary().mean, 2.0);
  window.add(4.0);
  EXPECT_DOUBLE_EQ(window.summary().min, 2.0);
}

TEST(SampleWindow, KnowsAllOfAFewSamples) {
  SampleWindow window(10);
  window.add(5.0);
  EXPECT_EQ(window.summary().count, 1U);
}

}  // namespace
}  // namespace tsg
