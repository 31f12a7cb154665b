#include "services/tsgctl/lib/map_text.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace tsg {
namespace {

using ::testing::HasSubstr;

MapFileReport example() {
  return {.path = "/maps/home.tsgmap",
          .bytes = 1'234'567,
          .version = 1,
          .info = {
              .created_ns = 1'700'000'000'999'000'000,
              .camera =
                  {.width = 640, .height = 480, .fx = 525.0, .fy = 525.0, .cx = 319.5, .cy = 239.5},
              .features = {.levels = 8, .scale_factor = 1.2, .pattern = 7},
              .parts = {{0, 12, 3456, {8.25, 3.0, 6.5}}, {2, 1, 30, {1.0, 2.0, 3.0}}}}};
}

TEST(MapText, HasWhatAUserWantsToKnow) {
  const std::string text = to_text(example());
  for (const char* part :
       {"/maps/home.tsgmap", "2023-11-14T22:13:20Z", "1.2 MB", "640x480", "keyframes  13",
        "points     3486", "12 keyframes, 3456 points, extent 8.2 x 3.0 x 6.5 m", "part 2"}) {
    EXPECT_THAT(text, HasSubstr(part));
  }
}

TEST(MapText, IsThereForScriptsToo) {
  const nlohmann::json json = to_json(example());
  EXPECT_EQ(json["format"], 1);
  EXPECT_EQ(json["bytes"], 1'234'567);
  EXPECT_EQ(json["created"], "2023-11-14T22:13:20Z");
  EXPECT_EQ(json["camera"]["fx"], 525.0);
  EXPECT_EQ(json["keyframes"], 13);
  EXPECT_EQ(json["parts"][0]["extent_m"][0], 8.25);
}

}  // namespace
}  // namespace tsg
