#include "services/slam/offline/laps.hpp"

#include <gtest/gtest.h>

namespace tsg {
namespace {

/// Three frames, 100 ns apart.
TumFolder short_sequence() {
  TumFolder sequence;
  for (const std::int64_t stamp_ns : {1000, 1100, 1200}) {
    sequence.frames.push_back({.stamp_ns = stamp_ns, .colour = {}, .depth = {}});
  }
  return sequence;
}

TEST(Laps, StampsGoOnByTheSameStepFromLapToLap) {
  const Laps laps = Laps::of(short_sequence(), 3);
  EXPECT_EQ(laps.stamp_ns(0, 1200), 1200);
  EXPECT_EQ(laps.stamp_ns(1, 1000), 1300);
  EXPECT_EQ(laps.stamp_ns(2, 1100), 1700);
}

TEST(Laps, TruthIsRepeatedWithoutWhatWasRecordedBeforeAndAfterTheSequence) {
  const Trajectory truth{{900, {}}, {1000, {}}, {1150, {}}, {1299, {}}, {1300, {}}};
  const Trajectory repeated = Laps::of(short_sequence(), 2).repeat(truth);
  std::vector<std::int64_t> stamps;
  for (const StampedPose& pose : repeated) stamps.push_back(pose.stamp_ns);
  EXPECT_EQ(stamps, (std::vector<std::int64_t>{1000, 1150, 1299, 1300, 1450, 1599}));
}

TEST(Laps, OneLapKeepsTheTruthAsItIs) {
  const Trajectory truth{{900, {}}, {1000, {}}, {1300, {}}};
  EXPECT_EQ(Laps::of(short_sequence(), 1).repeat(truth).size(), 3U);
}

}  // namespace
}  // namespace tsg
