#include "services/map_server/lib/ply.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cstring>

namespace tsg {
namespace {

constexpr std::string_view kEnd = "end_header\n";

TEST(Ply, WritesWhatItsHeaderSays) {
  ClassTable classes;
  const Cloud cloud{{{1.5F, -2.25F, 3.0F}, {1, 2, 3}, 57, 4},
                    {{0.0F, 0.5F, 0.25F}, {255, 254, 253}, kNotSegmentedClass, 1}};
  const std::string file = to_ply(cloud, classes);
  const std::size_t end = file.find(kEnd);
  ASSERT_NE(end, std::string::npos);
  const std::string header = file.substr(0, end);
  EXPECT_THAT(header, testing::StartsWith("ply\nformat binary_little_endian 1.0\n"));
  EXPECT_THAT(header, testing::HasSubstr("element vertex 2\nproperty float x\nproperty float y\n"
                                         "property float z\nproperty uchar red\nproperty uchar "
                                         "green\nproperty uchar blue\nproperty uchar class\n"));
  EXPECT_THAT(header, testing::HasSubstr("comment class 57 chair, colour "));

  const std::string body = file.substr(end + kEnd.size());
  ASSERT_EQ(body.size(), 2U * 16U);
  std::array<float, 3> position{};
  std::memcpy(position.data(), body.data(), sizeof(position));
  EXPECT_THAT(position, testing::ElementsAre(1.5F, -2.25F, 3.0F));
  EXPECT_EQ(body.substr(12, 4), std::string("\x01\x02\x03\x39"));
  EXPECT_EQ(body.substr(28, 4), std::string("\xff\xfe\xfd\x00", 4));  // not segmented: 0
}

TEST(Ply, KeepsAClassNameFromBreakingTheHeader) {
  ClassTable classes;
  const ClassId odd = classes.id_of("a\nelement vertex 9");
  const std::string file = to_ply({{{0.0F, 0.0F, 0.0F}, {}, odd, 1}}, classes);
  EXPECT_THAT(file, testing::HasSubstr("a?element vertex 9"));
  EXPECT_THAT(file, testing::HasSubstr("\nelement vertex 1\n"));
}

TEST(Ply, WritesAnEmptyCloud) {
  const std::string file = to_ply({}, ClassTable{});
  EXPECT_THAT(file, testing::HasSubstr("element vertex 0\n"));
  EXPECT_THAT(file, testing::EndsWith(std::string(kEnd)));
}

}  // namespace
}  // namespace tsg
