#include "services/tsgctl/lib/service_health.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace tsg {
namespace {

using ::testing::HasSubstr;

std::vector<ServiceHealth> slam_and_silent_camera() {
  return {{"camera", HealthState::kSilent, "", {}},
          {"slam",
           HealthState::kWarn,
           "lost",
           {{"frames_dropped", "3"}, {"latency_p50_ms", "12.345"}, {"latency_p99_ms", "30.000"}}}};
}

TEST(ServiceHealth, TableHasWhatAServiceSaysAndDashesForTheRest) {
  EXPECT_EQ(health_text(slam_and_silent_camera()),
            "SERVICE  STATE   RATE Hz  DROPPED  LATENCY ms p50/p99  MESSAGE\n"
            "camera   silent  -        -        -\n"
            "slam     warn    -        3        12.3/30.0           lost\n");
}

TEST(ServiceHealth, WarningsAreHealthySilenceIsNot) {
  EXPECT_EQ(unhealthy_names(slam_and_silent_camera()), "camera");
  EXPECT_FALSE(all_silent(slam_and_silent_camera()));
  EXPECT_TRUE(all_silent({{"camera", HealthState::kSilent, "", {}}}));
}

TEST(ServiceHealth, JsonHasEveryFigure) {
  const nlohmann::json json = health_json(slam_and_silent_camera());
  EXPECT_EQ(json["slam"]["values"]["frames_dropped"], "3");
  EXPECT_EQ(json["camera"]["state"], "silent");
}

TEST(ServiceHealth, FigureThatIsNoNumberStaysAsItIs) {
  EXPECT_THAT(health_text({{"slam", HealthState::kOk, "", {{"rate_hz", "unknown"}}}}),
              HasSubstr("unknown"));
}

}  // namespace
}  // namespace tsg
