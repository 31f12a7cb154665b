#include "services/tsgctl/lib/progress_line.hpp"

#include <gtest/gtest.h>

namespace tsg {
namespace {

TEST(ProgressLine, TellsFrameStateRateAndTimeLeft) {
  const ProgressState progress{104, 260, "tracking", 5.2};
  EXPECT_EQ(progress_text(progress), "frame 104/260 (40 %) tracking 20.0 fps ETA 0:08");
}

TEST(ProgressLine, TellsNoTimeLeftBeforeTheFirstFrame) {
  EXPECT_EQ(progress_text({0, 260, "starting", 0.0}), "frame 0/260 (0 %) starting 0.0 fps ETA -");
}

TEST(ProgressLine, BarFillsWithTheFramesDone) {
  EXPECT_EQ(progress_bar({130, 260, "tracking", 6.5}, 66),
            "[##########----------] 130/260  50 %  tracking  20.0 fps  ETA 0:07");
}

TEST(ProgressLine, BarNeverExceedsTheTerminal) {
  const ProgressState progress{104, 260, "tracking", 5.2};
  for (int columns = 1; columns < 200; ++columns) {
    EXPECT_LE(progress_bar(progress, columns).size(), static_cast<std::size_t>(columns));
  }
}

TEST(ProgressLine, MoreFramesThanAnnouncedStayAtOneHundredPercent) {
  EXPECT_EQ(progress_text({300, 260, "tracking", 10.0}),
            "frame 300/260 (100 %) tracking 30.0 fps ETA 0:00");
}

}  // namespace
}  // namespace tsg
