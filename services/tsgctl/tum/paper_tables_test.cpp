#include "services/tsgctl/tum/paper_tables.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "common/dataset/evaluation.hpp"

namespace tsg {
namespace {

/// RMSE, mean and standard deviation of the same numbers: rmse^2 = mean^2 + std^2. A digit copied
/// wrongly breaks it; where the paper itself breaks it, the test knows.
double mismatch(const PaperErrors& errors) {
  return std::abs(std::hypot(errors.mean, errors.std_dev) - errors.rmse) / errors.rmse;
}

TEST(PaperTables, FiguresAgreeAmongThemselvesExceptWhereThePaperIsMisprinted) {
  for (const PaperSequence& sequence : paper_sequences()) {
    EXPECT_LT(mismatch(sequence.orb_slam3.ate), 0.02) << sequence.name;
    if (sequence.table != 4) {
      EXPECT_LT(mismatch(sequence.tsg_slam.ate), 0.07) << sequence.name;
    } else {
      EXPECT_LT(sequence.tsg_slam.ate.rmse, sequence.tsg_slam.ate.mean) << sequence.name;
    }
  }
}

TEST(PaperTables, RatesOfTable5AreThoseOfTheErrors) {
  for (const PaperComparison& comparison : paper_comparisons()) {
    const PaperSequence* sequence = find_paper_sequence(comparison.name);
    ASSERT_NE(sequence, nullptr);
    const PaperErrors& orb = sequence->orb_slam3.ate;
    const PaperErrors& tsg = sequence->tsg_slam.ate;
    const PaperRates& own = comparison.rates.back();
    EXPECT_NEAR(*own.rmse, 100.0 * improvement_rate(orb.rmse, tsg.rmse), 0.01) << sequence->name;
    EXPECT_NEAR(*own.std_dev, 100.0 * improvement_rate(orb.std_dev, tsg.std_dev), 0.02)
        << sequence->name;
  }
}

TEST(TumNames, AreUnderstoodInBothSpellings) {
  for (const char* name : {"fr3/walking_xyz", "rgbd_dataset_freiburg3_walking_xyz"}) {
    EXPECT_EQ(tum_short_name(name).value(), "fr3/walking_xyz");
  }
  EXPECT_EQ(tum_folder_name("fr3/walking_xyz"), "rgbd_dataset_freiburg3_walking_xyz");
  for (const char* name : {"", "fr4/xyz", "walking_xyz", "fr3/../x", "fr3walking"}) {
    EXPECT_FALSE(tum_short_name(name)) << name;
  }
}

}  // namespace
}  // namespace tsg
