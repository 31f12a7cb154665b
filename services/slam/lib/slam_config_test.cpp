#include "services/slam/lib/slam_config.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

namespace tsg {
namespace {

using testing::ElementsAre;
using testing::StartsWith;

TEST(SlamConfig, DefaultsAreSound) { EXPECT_TRUE(SlamConfig{}.problems().empty()); }

TEST(SlamConfig, NamesEveryProblemWithItsKey) {
  SlamConfig config;
  config.features.scale_factor = 1.0;
  config.tracker.pixel_sigma = std::numeric_limits<double>::quiet_NaN();
  config.mapper.window_keyframes = 1;
  EXPECT_THAT(config.problems(),
              ElementsAre(StartsWith("features.scale_factor"), StartsWith("tracker.pixel_sigma"),
                          StartsWith("mapper.window_keyframes")));
}

TEST(SlamConfig, RejectsAClassThatIsBothDynamicAndPotentiallyDynamic) {
  SlamConfig config;
  config.dynamic_filter.potentially_dynamic_classes.emplace_back("person");
  EXPECT_THAT(config.problems(), ElementsAre(StartsWith("dynamic_filter.potentially_dynamic")));
}

}  // namespace
}  // namespace tsg
