#include "services/slam/lib/saved_map.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "services/slam/lib/map_encoding.hpp"
#include "services/slam/lib/synthetic_session.hpp"
#include "tests/support/temp_folder.hpp"

namespace tsg {
namespace {

using synthetic::example_map;
using synthetic::map_with_everything;
using synthetic::on_path;
using synthetic::room;
using synthetic::Session;
using synthetic::walk;
using ::testing::AllOf;
using ::testing::HasSubstr;

void expect_same(const SE3& a, const SE3& b) {
  EXPECT_EQ(a.rotation().coeffs(), b.rotation().coeffs());
  EXPECT_EQ(a.translation(), b.translation());
}

void expect_same(const Features& a, const Features& b) {
  EXPECT_EQ(a.seq, b.seq);
  EXPECT_EQ(a.stamp_ns, b.stamp_ns);
  EXPECT_EQ(a.descriptors, b.descriptors);
  EXPECT_EQ(a.surface.columns, b.surface.columns);
  EXPECT_EQ(a.surface.inverse_depths, b.surface.inverse_depths);
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a.items[i].pixel, b.items[i].pixel);
    EXPECT_EQ(a.items[i].inverse_depth, b.items[i].inverse_depth);
    EXPECT_EQ(a.items[i].angle, b.items[i].angle);
    EXPECT_EQ(a.items[i].raw_x, b.items[i].raw_x);
    EXPECT_EQ(a.items[i].raw_y, b.items[i].raw_y);
    EXPECT_EQ(a.items[i].level, b.items[i].level);
    EXPECT_EQ(a.items[i].verdict, b.items[i].verdict);
  }
}

void expect_same(const LocalMapSnapshot& a, const LocalMapSnapshot& b) {
  EXPECT_EQ(a.newest, b.newest);
  EXPECT_EQ(a.map_keyframes, b.map_keyframes);
  EXPECT_EQ(a.map_points, b.map_points);
  ASSERT_EQ(a.keyframes.size(), b.keyframes.size());
  for (std::size_t i = 0; i < a.keyframes.size(); ++i) {
    EXPECT_EQ(a.keyframes[i].id, b.keyframes[i].id);
    EXPECT_EQ(a.keyframes[i].points, b.keyframes[i].points);
    expect_same(a.keyframes[i].T_world_camera, b.keyframes[i].T_world_camera);
    expect_same(*a.keyframes[i].features, *b.keyframes[i].features);
  }
  ASSERT_EQ(a.points.size(), b.points.size());
  for (std::size_t i = 0; i < a.points.size(); ++i) {
    EXPECT_EQ(a.points[i].id, b.points[i].id);
    EXPECT_EQ(a.points[i].position, b.points[i].position);
    EXPECT_EQ(a.points[i].normal, b.points[i].normal);
    EXPECT_EQ(a.points[i].min_distance, b.points[i].min_distance);
    EXPECT_EQ(a.points[i].max_distance, b.points[i].max_distance);
    EXPECT_EQ(a.points[i].descriptor, b.points[i].descriptor);
    EXPECT_EQ(a.points[i].observations, b.points[i].observations);
  }
}

class SavedMap : public ::testing::Test {
 protected:
  MapContents saved_and_loaded(const MapContents& contents) {
    const auto saved = save_map(path_, contents, {}, 1);
    EXPECT_TRUE(saved) << saved.error().message;
    auto loaded = load_map(path_, {});
    EXPECT_TRUE(loaded) << loaded.error().message;
    return std::move(loaded).value_or(MapContents{});
  }
  test::TempFolder folder_;
  std::filesystem::path path_ = folder_ / "home.tsgmap";
};

TEST_F(SavedMap, GivesTheSameBytesWhenItIsSavedAgain) {
  const MapContents contents = map_with_everything();
  const MapContents loaded = saved_and_loaded(contents);
  EXPECT_EQ(encode_map(loaded), encode_map(contents));
  EXPECT_EQ(loaded.camera, contents.camera);
  expect_same(loaded.keyframes.front().T_world_camera, contents.keyframes.front().T_world_camera);
  EXPECT_TRUE(loaded.culled.at(contents.newest - 1).seq == 71);
}

TEST_F(SavedMap, GivesTheSameSnapshotAsTheMapThatWasSaved) {
  Session original;
  walk(original, 0, 20);
  LocalMapper restored(SlamConfig{}, saved_and_loaded(original.mapper().contents()));
  expect_same(*restored.snapshot(), *original.mapper().snapshot());
  const auto before = original.mapper().keyframe_poses();
  const auto after = restored.keyframe_poses();
  ASSERT_EQ(before.size(), after.size());
  for (std::size_t i = 0; i < before.size(); ++i) {
    EXPECT_EQ(after[i].id, before[i].id);
    expect_same(after[i].T_world_camera, before[i].T_world_camera);
  }
}

TEST_F(SavedMap, IsTrackedInAndGrowsBitForBitAsTheOneThatWasSaved) {
  Session original;
  walk(original, 0, 12);
  MapContents loaded = saved_and_loaded(original.mapper().contents());
  // Two trackers that both come into a map that is there already.
  Session one({}, original.mapper().contents());
  Session two({}, std::move(loaded));
  int keyframes = 0;
  for (int i = 11; i < 30; ++i) {
    const RgbdFrame frame = room().render(static_cast<std::uint64_t>(i), on_path(i));
    const TrackResult first = one.step(frame);
    const TrackResult second = two.step(frame);
    ASSERT_EQ(first.state, second.state) << i;
    ASSERT_EQ(first.keyframe.has_value(), second.keyframe.has_value());
    if (first.keyframe) {
      ++keyframes;
      EXPECT_GT(first.keyframe->id, original.mapper().contents().newest);
    }
    if (first.T_world_camera) expect_same(*first.T_world_camera, *second.T_world_camera);
  }
  EXPECT_GE(keyframes, 1) << "else nothing of mapping was compared";
  EXPECT_EQ(encode_map(one.mapper().contents()), encode_map(two.mapper().contents()));
}

TEST_F(SavedMap, IsLookedForAndFoundInTheFrameOfTheOldMap) {
  Session system({}, saved_and_loaded(example_map()));
  const RgbdFrame elsewhere = [] {
    RgbdFrame frame = synthetic::Scene({}).render(0, SE3());
    frame.colour = cv::Scalar::all(100);
    frame.depth = cv::Scalar(10000);
    return frame;
  }();
  const TrackResult lost = system.step(elsewhere);
  EXPECT_EQ(lost.state, TrackingState::kLost);
  EXPECT_THAT(lost.reason, HasSubstr("loaded map"));
  EXPECT_FALSE(lost.keyframe);
  const SE3 T_world_camera = synthetic::pose_at(0.1, 0.03, 0.02, 0.05);
  TrackResult found = system.step(room().render(1, T_world_camera));
  if (!found.T_world_camera) found = system.step(room().render(2, T_world_camera));
  ASSERT_TRUE(found.T_world_camera) << found.reason;
  EXPECT_TRUE(found.relocalised);
  EXPECT_LT((T_world_camera.inverse() * *found.T_world_camera).translation().norm(), 0.01);
}

TEST_F(SavedMap, DoesNotChangeInLocalisationOnly) {
  SlamConfig config;
  config.tracker.localisation_only = true;
  MapContents contents = example_map();
  contents.is_adjusting = true;
  Session system(config, saved_and_loaded(contents));
  const std::string before = encode_map(system.mapper().contents());
  EXPECT_FALSE(system.mapper().is_adjusting());
  int tracked = 0;
  for (int i = 0; i < 40; ++i) {  // twice as far as the map goes
    const TrackResult result =
        system.step(room().render(static_cast<std::uint64_t>(i), on_path(i)));
    EXPECT_FALSE(result.keyframe);
    if (result.T_world_camera) ++tracked;
  }
  EXPECT_GE(tracked, 38);
  EXPECT_EQ(encode_map(system.mapper().contents()), before);
}

TEST_F(SavedMap, KeepsItsKeyframesFromMasksOfTheNewSession) {
  LocalMapper restored(SlamConfig{}, saved_and_loaded(example_map()));
  InstanceSegmentation everything;
  everything.frame_seq = example_map().keyframes.back().features->seq;
  everything.labels = cv::Mat(480, 640, CV_8UC1, cv::Scalar(1));
  everything.instances.push_back({.class_name = "person", .score = 0.9F, .box = {}});
  const auto before = restored.snapshot();
  EXPECT_FALSE(restored.apply_mask(everything));
  EXPECT_EQ(restored.snapshot(), before);
}

TEST_F(SavedMap, ShowsThePartOfTheMapThatItIsCentredOn) {
  SlamConfig config;
  config.mapper.snapshot_keyframes = 1;
  LocalMapper restored(config, saved_and_loaded(example_map()));
  ASSERT_EQ(restored.snapshot()->keyframes.front().id, example_map().newest);
  const KeyframeId first = example_map().keyframes.front().id;
  restored.centre_on(first);
  EXPECT_EQ(restored.snapshot()->keyframes.front().id, first);
  EXPECT_EQ(restored.snapshot()->newest, example_map().newest);
  const auto before = restored.snapshot();
  restored.centre_on(example_map().newest + 7);
  EXPECT_EQ(restored.snapshot(), before);
}

TEST_F(SavedMap, TellsWhatIsInTheFile) {
  MapContents contents = map_with_everything();
  Keyframe elsewhere = contents.keyframes.back();  // a part that has just begun
  elsewhere.id = ++contents.newest;
  elsewhere.part = part_begun_by(elsewhere.id);
  contents.keyframes.push_back(elsewhere);
  const auto info = save_map(path_, contents, {}, 4711);
  ASSERT_TRUE(info) << info.error().message;
  const auto file = read_map_file(path_);
  ASSERT_TRUE(file);
  EXPECT_EQ(file->info, *info);
  EXPECT_EQ(info->created_ns, 4711);
  EXPECT_EQ(info->keyframes(), contents.keyframes.size());
  EXPECT_EQ(info->points(), contents.points.size());
  ASSERT_EQ(info->parts.size(), 2U);
  EXPECT_EQ(info->parts[1].part, elsewhere.part);
  EXPECT_EQ(info->parts[1].keyframes, 1U);
  EXPECT_GT(info->parts[0].extent_m.x(), 1.0) << "the wall is some metres wide";
}

TEST_F(SavedMap, OfOtherFeatureSettingsIsRefusedWithBoth) {
  ASSERT_TRUE(save_map(path_, example_map(), {}, 1));
  FeatureConfig other;
  other.levels = 6;
  const auto loaded = load_map(path_, other);
  ASSERT_FALSE(loaded);
  EXPECT_EQ(loaded.error().code, ExitCode::kConfig);
  EXPECT_THAT(loaded.error().message,
              AllOf(HasSubstr("home.tsgmap"), HasSubstr("levels=8"), HasSubstr("levels=6")));
}

TEST_F(SavedMap, OfAnotherDescriptorIsRefused) {
  const MapFileInfo info{.camera = synthetic::camera(),
                         .features = {.levels = 8, .scale_factor = 1.2, .pattern = 1},
                         .parts = {}};
  ASSERT_TRUE(write_map_file(path_, info, encode_map(example_map())));
  const auto loaded = load_map(path_, {});
  ASSERT_FALSE(loaded);
  EXPECT_THAT(loaded.error().message, HasSubstr("describes corners in another way"));
}

TEST_F(SavedMap, IsNotWrittenOverTheOldOneWhereTheFolderIsAbsent) {
  const auto saved = save_map(folder_ / "absent" / "x.tsgmap", example_map(), {}, 1);
  ASSERT_FALSE(saved);
  EXPECT_EQ(saved.error().code, ExitCode::kCannotWrite);
  EXPECT_THAT(saved.error().message, HasSubstr("create the folder first"));
}

}  // namespace
}  // namespace tsg
