#include "common/map_file/bytes.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <numbers>

namespace tsg {
namespace {

TEST(Bytes, ComeBackAsTheyWerePut) {
  const SE3 T_a_b(Eigen::Quaterniond(0.1, 0.2, 0.3, 0.4), Eigen::Vector3d(1.0, -2.0, 1e-300));
  ByteWriter out;
  out.put<std::uint8_t>(200);
  out.put<std::int16_t>(-2);
  out.put<std::uint64_t>(std::numeric_limits<std::uint64_t>::max());
  out.put<float>(-0.1F);
  out.put<double>(std::numbers::pi);
  out.put(T_a_b);
  const std::string bytes = out.take();
  ByteReader in(bytes);
  EXPECT_EQ(in.get<std::uint8_t>(), 200);
  EXPECT_EQ(in.get<std::int16_t>(), -2);
  EXPECT_EQ(in.get<std::uint64_t>(), std::numeric_limits<std::uint64_t>::max());
  EXPECT_EQ(in.get<float>(), -0.1F);
  EXPECT_EQ(in.get<double>(), std::numbers::pi);
  const SE3 again = in.get_pose();
  EXPECT_EQ(again.rotation().coeffs(), T_a_b.rotation().coeffs());
  EXPECT_EQ(again.translation(), T_a_b.translation());
  EXPECT_TRUE(in.is_ok());
  EXPECT_EQ(in.left(), 0U);
}

TEST(Bytes, AreTheSameOnEveryMachine) {
  ByteWriter out;
  out.put<std::uint32_t>(0x01020304);
  out.put<float>(1.0F);
  EXPECT_EQ(out.take(), std::string("\x04\x03\x02\x01\x00\x00\x80\x3f", 8));
}

TEST(Bytes, EndInTheMiddleOfANumberIsAProblemThatLasts) {
  ByteReader in("abcde");
  EXPECT_NE(in.get<std::uint32_t>(), 0U);
  EXPECT_EQ(in.get<std::uint16_t>(), 0);
  EXPECT_FALSE(in.is_ok());
  EXPECT_EQ(in.get<std::uint8_t>(), 0) << "although there is one";
}

TEST(Bytes, CountThatCannotBeIsAProblemBeforeMemoryIsTaken) {
  ByteWriter out;
  out.put<std::uint64_t>(3);
  out.put<std::uint64_t>(0);
  const std::string bytes = out.take();
  EXPECT_EQ(ByteReader(bytes).get_count(2), 3U);
  ByteReader in(bytes);
  EXPECT_EQ(in.get_count(4), 0U) << "8 bytes are left";
  EXPECT_FALSE(in.is_ok());
}

TEST(Bytes, PoseThatIsNoneIsAProblem) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const auto& numbers : {std::array{0.0, 0.0, 0.0, 1.1, 0.0, 0.0, 0.0},
                              std::array{0.0, nan, 0.0, 1.0, 0.0, 0.0, 0.0},
                              std::array{0.0, 0.0, 0.0, 1.0, 0.0, nan, 0.0}}) {
    ByteWriter out;
    for (const double number : numbers) out.put<double>(number);
    const std::string bytes = out.take();
    ByteReader in(bytes);
    EXPECT_TRUE(in.get_pose().is_finite());
    EXPECT_FALSE(in.is_ok());
  }
}

TEST(Bytes, FirstProblemIsTheOneThatIsTold) {
  ByteReader in("");
  in.fail("first");
  in.fail("second");
  EXPECT_EQ(in.problem(), "first");
}

}  // namespace
}  // namespace tsg
