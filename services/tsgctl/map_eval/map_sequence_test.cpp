#include "services/tsgctl/map_eval/map_sequence.hpp"

#include <gtest/gtest.h>

#include "tests/support/temp_folder.hpp"

namespace tsg {
namespace {

/// Two chairs side by side and a person; of the right chair the truth says that it moves.
InstanceSegmentation two_chairs() {
  InstanceSegmentation mask;
  mask.instances = {{.class_name = "chair", .score = 1.0F, .box = {0, 0, 100, 100}},
                    {.class_name = "chair",
                     .score = 1.0F,
                     .box = {100, 0, 100, 100},
                     .motion = MotionVerdict::kMoving},
                    {.class_name = "person", .score = 1.0F, .box = {50, 0, 100, 100}}};
  return mask;
}

InstanceState state(const std::string& class_name, const cv::Rect& box, bool is_moving) {
  return {.id = 1, .class_name = class_name, .is_moving = is_moving, .box = box};
}

TEST(WithVerdicts, TakesThoseOfTheBoxThatOverlapsMost) {
  FrameVerdicts verdicts;
  verdicts.instances = {state("chair", {10, 0, 100, 100}, true),
                        state("chair", {100, 10, 100, 90}, false)};
  const InstanceSegmentation judged = with_verdicts(two_chairs(), verdicts);
  EXPECT_EQ(judged.instances[0].motion, MotionVerdict::kMoving);
  EXPECT_EQ(judged.instances[1].motion, MotionVerdict::kStatic) << "not what the truth says";
}

TEST(WithVerdicts, KnowNothingOfWhatSlamDoesNotFollow) {
  FrameVerdicts verdicts;
  verdicts.instances = {state("chair", {60, 0, 100, 100}, true),  // a quarter in common
                        state("tv", {50, 0, 100, 100}, true)};    // of another class
  for (const Instance& instance : with_verdicts(two_chairs(), verdicts).instances) {
    EXPECT_EQ(instance.motion, MotionVerdict::kUnknown) << instance.class_name;
  }
}

TEST(PlanKeyframes, NamesTheFolderThatIsNotThere) {
  const test::TempFolder folder;
  MapSequenceOptions options;
  options.folder = folder / "nothing";
  try {
    (void)plan_keyframes(options, {});
    FAIL() << "a folder that is not there was read";
  } catch (const FatalError& error) {
    EXPECT_EQ(error.code(), ExitCode::kMissingInput);
    EXPECT_NE(std::string(error.what()).find("nothing"), std::string::npos);
  }
}

}  // namespace
}  // namespace tsg
