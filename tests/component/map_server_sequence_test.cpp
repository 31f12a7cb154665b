// The map server's library on a rendered sequence with true poses and masks: people walk through
// the view all the time and must leave no trace.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <iostream>
#include <iterator>
#include <set>
#include <string>
#include <tuple>

#include "common/dataset/instance_truth.hpp"
#include "common/dataset/trajectory.hpp"
#include "common/dataset/tum_folder.hpp"
#include "services/map_server/lib/semantic_map.hpp"
#include "tests/support/shared_dir.hpp"

namespace tsg::test {
namespace {

constexpr std::size_t kEveryFrame = 10;  // three keyframes a second

const SE3& pose_at(const Trajectory& truth, std::int64_t stamp_ns) {
  const auto after = std::lower_bound(
      truth.begin(), truth.end(), stamp_ns,
      [](const StampedPose& pose, std::int64_t stamp) { return pose.stamp_ns < stamp; });
  if (after == truth.begin()) return after->T_world_camera;
  const auto before = std::prev(after);
  const bool is_before_closer =
      after == truth.end() || stamp_ns - before->stamp_ns < after->stamp_ns - stamp_ns;
  return (is_before_closer ? before : after)->T_world_camera;
}

class RecordedRoom {
 public:
  explicit RecordedRoom(const std::filesystem::path& path)
      : folder_(value_or_throw(open_tum_folder(path))),
        truth_(value_or_throw(read_ground_truth(path))),
        masks_(value_or_throw(InstanceTruth::open(path))) {}

  [[nodiscard]] std::size_t frames() const { return folder_.frames.size(); }

  [[nodiscard]] MapKeyframe keyframe(std::size_t index) const {
    MapKeyframe keyframe;
    keyframe.id = index;
    keyframe.frame = value_or_throw(read_frame(folder_, index));
    keyframe.T_world_camera = pose_at(truth_, keyframe.frame.stamp_ns);
    keyframe.instances = value_or_throw(masks_.at(keyframe.frame.stamp_ns));
    keyframe.has_labels = true;
    return keyframe;
  }

 private:
  TumFolder folder_;
  Trajectory truth_;
  InstanceTruth masks_;
};

using Leaf = std::tuple<int, int, int>;

/// Leaves in which a person was seen, well inside the mask and at least one leaf away from any
/// leaf in which something else was seen in the same keyframe.
std::set<Leaf> leaves_of_people(const MapKeyframe& keyframe, double leaf_m) {
  ExclusionConfig nobody;
  nobody.dynamic_classes.clear();
  MapKeyframe all = keyframe;
  for (Instance& instance : all.instances.instances) instance.motion = MotionVerdict::kStatic;
  ClassTable classes;
  const ClassId person = classes.id_of("person");
  const Cloud cloud = BackProjector({}, nobody).project(all, classes).points;
  std::set<Leaf> people;
  std::set<Leaf> others;
  for (const CloudPoint& point : cloud) {
    const Eigen::Vector3d world = keyframe.T_world_camera * point.position.cast<double>();
    const Eigen::Vector3i cell = (world / leaf_m).array().floor().cast<int>();
    (point.class_id == person ? people : others).emplace(cell.x(), cell.y(), cell.z());
  }
  for (const auto& [x, y, z] : others) {
    for (int i = 0; i < 27; ++i) people.erase({x + i % 3 - 1, y + i / 3 % 3 - 1, z + i / 9 - 1});
  }
  return people;
}

std::size_t occupied_of(const SemanticMap& map, const std::set<Leaf>& leaves) {
  const auto leaf_m = static_cast<float>(map.octree().getResolution());
  return static_cast<std::size_t>(
      std::count_if(leaves.begin(), leaves.end(), [&](const Leaf& leaf) {
        const auto& [x, y, z] = leaf;
        const Eigen::Vector3i cell(x, y, z);
        return map.octree().is_occupied_at(leaf_m * (cell.cast<float>().array() + 0.5F));
      }));
}

int objects_named(const MapSummary& summary, const std::string& name) {
  const auto found = std::find_if(summary.objects.begin(), summary.objects.end(),
                                  [&](const ObjectClass& object) { return object.name == name; });
  return found == summary.objects.end() ? 0 : found->max_in_view;
}

TEST(MapOfWalkingPeople, HoldsNoPeopleAndKnowsTheFurniture) {
  TSG_REQUIRE_SHARED("data/rendered/walking_xyz");
  const RecordedRoom room(shared_dir() / "data/rendered/walking_xyz");
  SemanticMap map{MapConfig{}};
  std::set<Leaf> people;
  for (std::size_t index = 0; index < room.frames(); index += kEveryFrame) {
    const MapKeyframe keyframe = room.keyframe(index);
    people.merge(leaves_of_people(keyframe, map.octree().getResolution()));
    const auto integrated = map.integrate(keyframe);
    ASSERT_TRUE(integrated) << integrated.error().message;
  }
  const MapSummary summary = map.summary();
  const std::size_t traces = occupied_of(map, people);
  std::cout << summary.keyframes << " keyframes, " << summary.points_raw << " points, "
            << summary.points << " after filtering, " << summary.leaves << " occupied leaves, "
            << traces << " of the " << people.size() << " where people were\n";
  EXPECT_GT(people.size(), 2000U);  // else there is nothing to be found
  EXPECT_LE(static_cast<double>(traces), 0.005 * static_cast<double>(summary.leaves));
  EXPECT_EQ(objects_named(summary, "person"), 0);
  EXPECT_EQ(objects_named(summary, "chair"), 2);
  EXPECT_EQ(objects_named(summary, "dining table"), 2);
}

TEST(MapOfWalkingPeople, WouldHoldThemWithoutMasks) {
  TSG_REQUIRE_SHARED("data/rendered/walking_xyz");
  const RecordedRoom room(shared_dir() / "data/rendered/walking_xyz");
  SemanticMap map{MapConfig{}};
  MapKeyframe keyframe = room.keyframe(130);
  const std::set<Leaf> people = leaves_of_people(keyframe, map.octree().getResolution());
  keyframe.has_labels = false;
  keyframe.instances = {};
  ASSERT_TRUE(map.integrate(keyframe));
  EXPECT_GT(people.size(), 100U);
  EXPECT_GT(occupied_of(map, people), people.size() / 2);
}

}  // namespace
}  // namespace tsg::test
