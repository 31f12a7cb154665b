#include "common/core/shared_value.hpp"

#include <gtest/gtest.h>

#include <thread>

namespace tsg {
namespace {

TEST(SharedValue, IsNullUntilThereIsOne) {
  SharedValue<int> value;
  EXPECT_EQ(value.load(), nullptr);
  value.store(std::make_shared<const int>(7));
  ASSERT_NE(value.load(), nullptr);
  EXPECT_EQ(*value.load(), 7);
}

TEST(SharedValue, StaysWithItsReaderWhenANewerOneCame) {
  SharedValue<int> value(std::make_shared<const int>(1));
  const auto read = value.load();
  value.store(std::make_shared<const int>(2));
  EXPECT_EQ(*read, 1);
  EXPECT_EQ(read.use_count(), 1);
}

TEST(SharedValue, IsNeverOlderThanWhatWasReadBefore) {
  constexpr int kLast = 2000;
  SharedValue<int> value(std::make_shared<const int>(0));
  std::jthread writer([&] {
    for (int i = 1; i <= kLast; ++i) value.store(std::make_shared<const int>(i));
  });
  for (int latest = 0; latest < kLast;) {
    const int read = *value.load();
    ASSERT_GE(read, latest);
    latest = read;
  }
}

}  // namespace
}  // namespace tsg
