#include "services/camera/lib/replay_source.hpp"

#include <gtest/gtest.h>

#include "tests/support/synthetic_sequence.hpp"

namespace tsg {
namespace {

using test::is_same_image;
using test::SyntheticSequence;
using test::TempFolder;

class ReplaySources : public ::testing::Test {
 protected:
  void SetUp() override { sequence_.write_to(folder_); }

  std::unique_ptr<ReplaySource> open(bool loop = false) {
    auto source = ReplaySource::open({.folder = folder_.path().string(), .loop = loop});
    EXPECT_TRUE(source) << source.error().message;
    return std::move(*source);
  }

  TempFolder folder_;
  SyntheticSequence sequence_;
};

TEST_F(ReplaySources, KnowTheCameraOfTheRecording) {
  const auto source = open();
  EXPECT_EQ(source->info().camera.width, 64);
  EXPECT_DOUBLE_EQ(source->info().depth_units_per_metre, 5000.0);
  EXPECT_DOUBLE_EQ(source->info().fps, 30.0);
}

TEST_F(ReplaySources, GiveEveryFrameOnceThenTheEnd) {
  const auto source = open();
  const cv::Mat colour(sequence_.size, CV_8UC3);
  const cv::Mat depth(sequence_.size, CV_16UC1);
  for (int i = 0; i < sequence_.frames; ++i) {
    const auto frame = source->next();
    ASSERT_TRUE(frame && *frame);
    EXPECT_EQ((*frame)->stamp_ns(), sequence_.stamp_ns(i));
    ASSERT_TRUE((*frame)->decode(colour, depth));
    EXPECT_TRUE(is_same_image(colour, sequence_.colour(i)));
    EXPECT_TRUE(is_same_image(depth, sequence_.depth(i)));
  }
  EXPECT_EQ(*source->next(), nullptr);
  EXPECT_EQ(*source->next(), nullptr);
}

TEST_F(ReplaySources, GoOnWithTheFirstFrameAndLaterStampsInALoop) {
  const auto source = open(true);
  for (int i = 0; i < sequence_.frames; ++i) ASSERT_TRUE(*source->next());
  const auto again = source->next();
  ASSERT_TRUE(again && *again);
  EXPECT_EQ((*again)->stamp_ns(), sequence_.stamp_ns(sequence_.frames - 1) + 33'333'333);
}

TEST_F(ReplaySources, PassOnWhatIsWrongWithTheFolder) {
  const auto source = ReplaySource::open({.folder = (folder_ / "none").string()});
  ASSERT_FALSE(source);
  EXPECT_EQ(source.error().code, ExitCode::kMissingInput);
}

TEST(ReplaySource, NeedsAFolder) {
  const auto source = ReplaySource::open({});
  ASSERT_FALSE(source);
  EXPECT_EQ(source.error().code, ExitCode::kConfig);
}

}  // namespace
}  // namespace tsg
