#include "common/dataset/stamp.hpp"

#include <gtest/gtest.h>

#include <random>

namespace tsg {
namespace {

TEST(ParseStamp, KeepsEveryDigitToTheNanosecond) {
  EXPECT_EQ(parse_stamp_ns("1305031453.359684"), 1305031453359684000);
  EXPECT_EQ(parse_stamp_ns("1305031453.123456789"), 1305031453123456789);
  EXPECT_EQ(parse_stamp_ns("1305031453"), 1305031453000000000);
  EXPECT_EQ(parse_stamp_ns("1305031453."), 1305031453000000000);
  EXPECT_EQ(parse_stamp_ns(".5"), 500000000);
  EXPECT_EQ(parse_stamp_ns("0"), 0);
}

TEST(ParseStamp, RoundsWhatLiesBeyondNanoseconds) {
  EXPECT_EQ(parse_stamp_ns("1.0000000004"), 1000000000);
  EXPECT_EQ(parse_stamp_ns("1.0000000005"), 1000000001);
}

TEST(ParseStamp, TakesSignsAndExponents) {
  EXPECT_EQ(parse_stamp_ns("-0.25"), -250000000);
  EXPECT_EQ(parse_stamp_ns("+2"), 2000000000);
  EXPECT_EQ(parse_stamp_ns("1.305031102175299883e+09"), 1305031102175299883);
  EXPECT_EQ(parse_stamp_ns("25E-1"), 2500000000);
  EXPECT_EQ(parse_stamp_ns("7e-9"), 7);
  EXPECT_EQ(parse_stamp_ns("7e-20"), 0);
}

TEST(ParseStamp, RefusesWhatIsNoNumberOrDoesNotFit) {
  for (const char* text : {"", "-", ".", "1.2.3", "12a", "1e", "1e+", "1e1.5", "nan", "inf", "0x10",
                           " 1", "9223372037", "1403636579763555584", "1e99", "1e999"}) {
    EXPECT_FALSE(parse_stamp_ns(text)) << '"' << text << '"';
  }
}

TEST(FormatStamp, WritesAFixedNumberOfDecimalsRounded) {
  EXPECT_EQ(format_stamp(1305031453359684000, StampDecimals::kMicroseconds), "1305031453.359684");
  EXPECT_EQ(format_stamp(1'000'000'400, StampDecimals::kMicroseconds), "1.000000");
  EXPECT_EQ(format_stamp(1'999'999'500, StampDecimals::kMicroseconds), "2.000000");
  EXPECT_EQ(format_stamp(-250, StampDecimals::kNanoseconds), "-0.000000250");
  EXPECT_EQ(format_stamp(-250, StampDecimals::kMicroseconds), "0.000000");
}

TEST(FormatStamp, IsTheInverseOfParsing) {
  constexpr unsigned kSeed = 7;
  SCOPED_TRACE(kSeed);
  std::mt19937_64 random(kSeed);
  std::uniform_int_distribution<std::int64_t> stamps(-4'000'000'000'000'000'000,
                                                     4'000'000'000'000'000'000);
  for (int i = 0; i < 1000; ++i) {
    const std::int64_t stamp_ns = stamps(random);
    EXPECT_EQ(parse_stamp_ns(format_stamp(stamp_ns, StampDecimals::kNanoseconds)), stamp_ns);
  }
}

}  // namespace
}  // namespace tsg
