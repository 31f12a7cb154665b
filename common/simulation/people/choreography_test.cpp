#include "common/simulation/people/choreography.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

namespace tsg::simulation {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr double kFrameS = 1.0 / 30.0;

PersonDescription person(const std::string& name, const std::vector<ActionDescription>& actions) {
  PersonDescription result;
  result.name = name;
  result.look = 3;
  result.actions = actions;
  return result;
}

ActionDescription walk(const std::vector<Eigen::Vector2d>& path) {
  ActionDescription action;
  action.kind = ActionKind::kWalk;
  action.path_m = path;
  return action;
}

ActionDescription sit(const std::string& object, double duration_s) {
  ActionDescription action;
  action.kind = ActionKind::kSit;
  action.object = object;
  action.duration_s = duration_s;
  return action;
}

ActionDescription push(const std::string& object, const std::vector<Eigen::Vector2d>& path) {
  ActionDescription action;
  action.kind = ActionKind::kPush;
  action.object = object;
  action.path_m = path;
  action.speed_mps = 0.5;
  return action;
}

ActionDescription stand(double duration_s) {
  ActionDescription action;
  action.duration_s = duration_s;
  return action;
}

SE3 at(double x, double y, double z, double yaw) {
  return {Eigen::Quaterniond(Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ())), {x, y, z}};
}

std::map<std::string, Prop> props() {
  std::map<std::string, Prop> result;
  result["chair"] = {at(3.0, 0.5, 0.0, 0.4), Seat{{0.0, 0.0, 0.46}}, {0.28, 0.28}, 0.95, 0.0};
  result["box"] = {at(2.0, -1.0, 0.0, 0.2), std::nullopt, {0.15, 0.2}, 0.3, 0.0};
  result["table"] = {at(5.0, 3.0, 0.0, 0.0), std::nullopt, {0.8, 0.4}, 0.7, 0.72};
  return result;
}

Choreography planned(const std::vector<PersonDescription>& people) {
  auto result = Choreography::plan(people, props(), 7);
  EXPECT_TRUE(result) << result.error().message;
  return std::move(*result);
}

std::string error_of(const PersonDescription& someone) {
  const auto result = Choreography::plan({someone}, props(), 7);
  return result ? "no error" : result.error().message;
}

struct Body {
  std::vector<Eigen::Vector3f> points;
  std::vector<Eigen::Vector3f> normals;

  [[nodiscard]] Eigen::Vector3f lowest() const {
    Eigen::Vector3f result = points.front();
    for (const Eigen::Vector3f& point : points) {
      if (point.z() < result.z()) result = point;
    }
    return result;
  }
  [[nodiscard]] Eigen::Vector3f middle() const {
    Eigen::Vector3f sum = Eigen::Vector3f::Zero();
    for (const Eigen::Vector3f& point : points) sum += point;
    return sum / static_cast<float>(points.size());
  }
  [[nodiscard]] float top() const {
    float result = 0.0F;
    for (const Eigen::Vector3f& point : points) result = std::max(result, point.z());
    return result;
  }
};

Body body_at(const Choreography& choreography, double time_s, std::size_t who = 0) {
  Body body;
  choreography.pose(who, time_s, body.points, body.normals);
  return body;
}

double yaw_of(const SE3& T_world_object) {
  const Eigen::Vector3d front = T_world_object.rotation() * Eigen::Vector3d::UnitX();
  return std::atan2(front.y(), front.x());
}

TEST(Choreography, MeshIsWholeWhateverThePersonLooksLike) {
  for (std::uint64_t look = 1; look <= 8; ++look) {
    PersonDescription someone = person("anna", {});
    someone.look = look;
    const Choreography choreography = planned({someone});
    const render::Mesh& mesh = choreography.mesh(0);
    ASSERT_EQ(mesh.normals.size(), mesh.points.size());
    ASSERT_EQ(mesh.uvs.size(), mesh.points.size());
    EXPECT_LT(mesh.triangles.size(), 15000U);
    for (const render::Triangle& triangle : mesh.triangles) {
      for (const std::uint32_t corner : triangle.corners) ASSERT_LT(corner, mesh.points.size());
      ASSERT_LT(triangle.material, mesh.materials.size());
    }
    const Body body = body_at(choreography, 1.0);
    for (std::size_t i = 0; i < body.points.size(); ++i) {
      ASSERT_TRUE(body.points[i].allFinite());
      ASSERT_NEAR(body.normals[i].norm(), 1.0F, 1e-4F);
    }
    EXPECT_NEAR(body.top(), 1.75F, 0.06F) << "look " << look;
    EXPECT_NEAR(body.lowest().z(), 0.0F, 0.01F);
  }
}

TEST(Choreography, NormalsLookOutwards) {
  const Choreography choreography = planned({person("anna", {})});
  const render::Mesh& mesh = choreography.mesh(0);
  double volume = 0.0;  // six times; positive where faces turn counter-clockwise seen from outside
  for (const render::Triangle& triangle : mesh.triangles) {
    const auto& [a, b, c] = triangle.corners;
    volume += static_cast<double>(mesh.points[a].dot(mesh.points[b].cross(mesh.points[c])));
  }
  EXPECT_GT(volume / 6.0, 0.05);
  EXPECT_LT(volume / 6.0, 0.15);
}

TEST(Choreography, WalkEndsWhereThePathDoes) {
  const Choreography choreography =
      planned({person("anna", {walk({{3.0, 0.0}, {3.0, 2.0}, {0.0, 2.5}})})});
  const Eigen::Vector3f middle = body_at(choreography, 20.0).middle();
  EXPECT_NEAR(middle.x(), 0.0F, 0.1F);
  EXPECT_NEAR(middle.y(), 2.5F, 0.1F);
}

TEST(Choreography, NothingOfABodyMovesFasterThanEightMetresASecond) {
  ActionDescription talk = stand(2.0);
  talk.gesture = "wave";
  ActionDescription turn = stand(1.0);
  turn.has_yaw = true;
  turn.yaw_rad = 3.0;
  ActionDescription carry = walk({{4.0, 2.0}});
  carry.carry = "box";
  const Choreography choreography =
      planned({person("anna", {walk({{1.5, 0.0}, {1.5, -1.0}, {1.5, 0.5}}), talk, turn,
                               sit("chair", 2.0), push("chair", {{4.0, 1.0}}), carry})});
  Body before = body_at(choreography, 0.0);
  for (int frame = 1; frame < 60 * 30; ++frame) {
    const Body now = body_at(choreography, frame * kFrameS);
    float fastest = 0.0F;
    for (std::size_t i = 0; i < now.points.size(); ++i) {
      fastest = std::max(fastest, (now.points[i] - before.points[i]).norm());
    }
    ASSERT_LT(fastest / kFrameS, 8.0) << "at " << frame * kFrameS << " s";
    before = now;
  }
}

TEST(Choreography, SitsOnTheSeatWithThighsLevel) {
  const Choreography choreography = planned({person("anna", {sit("chair", 10.0)})});
  const Body body = body_at(choreography, 9.0);
  EXPECT_LT(body.top(), 1.45F);
  EXPECT_GT(body.top(), 1.2F);
  EXPECT_NEAR(body.lowest().z(), 0.0F, 0.02F);
  const SE3 T_chair_world = at(3.0, 0.5, 0.0, 0.4).inverse();
  float lowest_on_seat = 10.0F;
  for (const Eigen::Vector3f& point : body.points) {
    const Eigen::Vector3d in_chair = T_chair_world * point.cast<double>();
    if (std::abs(in_chair.x()) < 0.1 && std::abs(in_chair.y()) < 0.15) {
      lowest_on_seat = std::min(lowest_on_seat, point.z());
    }
  }
  EXPECT_NEAR(lowest_on_seat, 0.46F, 0.035F);
}

TEST(Choreography, WhoStartsOnTheSeatSitsFromTheOutset) {
  PersonDescription someone = person("anna", {sit("chair", 5.0)});
  someone.start.position_m = {3.1, 0.5};
  EXPECT_LT(body_at(planned({someone}), 0.0).top(), 1.45F);
}

TEST(Choreography, PushedChairGoesFromWhereItStandsToTheEndWithoutJumps) {
  const Choreography choreography =
      planned({person("anna", {push("chair", {{5.0, 1.0}, {5.0, 3.0}})})});
  EXPECT_THAT(choreography.moved_objects(), ElementsAre("chair"));
  const SE3 start = choreography.T_world_object("chair", 0.0);
  EXPECT_EQ(start.translation(), Eigen::Vector3d(3.0, 0.5, 0.0));
  SE3 before = start;
  for (int frame = 1; frame < 30 * 30; ++frame) {
    const SE3 now = choreography.T_world_object("chair", frame * kFrameS);
    ASSERT_LT((now.translation() - before.translation()).norm(), 0.02) << frame * kFrameS;
    ASSERT_LT((before.inverse() * now).angle(), 0.1) << frame * kFrameS;
    before = now;
  }
  EXPECT_LT((before.translation() - Eigen::Vector3d(5.0, 3.0, 0.0)).norm(), 0.01);
  EXPECT_NEAR(yaw_of(before), M_PI / 2.0, 0.05);
  EXPECT_EQ(choreography.T_world_object("chair", 100.0).translation(),
            choreography.T_world_object("chair", 200.0).translation());
}

TEST(Choreography, OneWhoPullsWalksBackwardsBeforeTheChair) {
  ActionDescription pull = push("chair", {{0.0, -0.5}});
  pull.pull = true;
  const Choreography choreography = planned({person("anna", {pull})});
  EXPECT_NEAR(std::abs(yaw_of(choreography.T_world_object("chair", 60.0))), 0.32, 0.1);
  EXPECT_LT(body_at(choreography, 60.0).middle().x(), -0.5F);
}

TEST(Choreography, CarriedBoxEndsOnTheTable) {
  ActionDescription carry = walk({{5.0, 1.9}, {5.0, 2.4}});
  carry.carry = "box";
  const Choreography choreography = planned({person("anna", {carry, stand(1.0)})});
  double highest = 0.0;
  SE3 before = choreography.T_world_object("box", 0.0);
  for (int frame = 1; frame < 30 * 30; ++frame) {
    const SE3 now = choreography.T_world_object("box", frame * kFrameS);
    highest = std::max(highest, now.translation().z());
    ASSERT_LT((now.translation() - before.translation()).norm(), 0.06) << frame * kFrameS;
    before = now;
  }
  EXPECT_NEAR(highest, 0.98, 0.02);
  EXPECT_NEAR(before.translation().z(), 0.72, 1e-6);
  EXPECT_NEAR(before.translation().y(), 2.9, 0.05);
}

TEST(Choreography, OneWaitsForTheChairThatAnotherSitsOn) {
  PersonDescription anna = person("anna", {sit("chair", 8.0), walk({{0.0, 3.0}})});
  PersonDescription ben = person("ben", {push("chair", {{6.0, 0.0}})});
  ben.start.position_m = {2.0, 2.0};
  const Choreography choreography = planned({anna, ben});
  EXPECT_EQ(choreography.T_world_object("chair", 12.0).translation().x(), 3.0);
  EXPECT_NEAR(choreography.T_world_object("chair", 60.0).translation().x(), 6.0, 0.01);
}

TEST(Choreography, WhoRepeatsComesBackAndGoesAgain) {
  PersonDescription someone = person("anna", {walk({{2.0, 0.0}})});
  someone.repeat = true;
  const Choreography choreography = planned({someone});
  int visits = 0;
  bool was_there = false;
  for (int quarter = 0; quarter < 240; ++quarter) {
    const bool is_there = body_at(choreography, 0.25 * quarter).middle().x() > 1.9F;
    visits += is_there && !was_there ? 1 : 0;
    was_there = is_there;
  }
  EXPECT_GT(visits, 5);
}

TEST(Choreography, TheSameInputGivesTheSameBits) {
  const std::vector<PersonDescription> people{
      person("anna", {walk({{3.0, 1.0}}), sit("chair", 2.0)})};
  const Choreography first = planned(people);
  const Choreography second = planned(people);
  for (int i = 0; i < 18; ++i) {
    const double time_s = 0.7 * i;
    EXPECT_EQ(body_at(first, time_s).points, body_at(second, time_s).points);
  }
}

TEST(Choreography, PeopleOfDifferentLooksDiffer) {
  PersonDescription anna = person("anna", {});
  PersonDescription ben = person("ben", {});
  ben.look = 4;
  const Choreography choreography = planned({anna, ben});
  const auto colour = [&](std::size_t who) {
    const render::Mesh& mesh = choreography.mesh(who);
    Eigen::Vector3f sum = Eigen::Vector3f::Zero();
    for (const render::Material& material : mesh.materials) {
      sum += material.texture->sample({0.3F, 0.3F}, 1.0F);
    }
    return sum;
  };
  EXPECT_GT((colour(0) - colour(1)).norm(), 0.05F);
}

TEST(Choreography, EachMistakeNamesPersonActionAndFix) {
  EXPECT_THAT(error_of(person("anna", {stand(1.0), sit("sofa", 1.0)})),
              AllOf(HasSubstr("person 'anna', action 2 (sit)"), HasSubstr("'sofa'"),
                    HasSubstr("name one that is")));
  EXPECT_THAT(error_of(person("anna", {sit("box", 1.0)})), HasSubstr("has no seat"));
  EXPECT_THAT(error_of(person("anna", {sit("", 1.0)})), HasSubstr("names no object"));
  EXPECT_THAT(error_of(person("anna", {walk({})})), HasSubstr("path without corners"));
  EXPECT_THAT(error_of(person("anna", {push("chair", {})})), HasSubstr("path without corners"));
  ActionDescription wrong = stand(1.0);
  wrong.gesture = "dance";
  EXPECT_THAT(error_of(person("anna", {wrong})), HasSubstr("'dance'"));
  wrong = stand(-1.0);
  EXPECT_THAT(error_of(person("anna", {wrong})), HasSubstr("duration"));
  wrong = walk({{1.0, 0.0}});
  wrong.speed_mps = 0.0;
  EXPECT_THAT(error_of(person("anna", {wrong})), HasSubstr("speed"));
  wrong = walk({{1.0, NAN}});
  EXPECT_THAT(error_of(person("anna", {wrong})), HasSubstr("not a number"));
  wrong = sit("chair", 1.0);
  wrong.carry = "box";
  EXPECT_THAT(error_of(person("anna", {wrong})), HasSubstr("cannot carry 'box'"));
  PersonDescription giant = person("anna", {});
  giant.height_m = 3.0;
  EXPECT_THAT(error_of(giant), HasSubstr("height"));
  giant.height_m = 1.7;
  giant.begin_s = -1.0;
  EXPECT_THAT(error_of(giant), HasSubstr("begin_s"));
  giant.begin_s = 0.0;
  giant.start.yaw_rad = NAN;
  EXPECT_THAT(error_of(giant), HasSubstr("not a number"));
}

TEST(Choreography, AChairThatIsNeverLeftIsAnError) {
  PersonDescription ben = person("ben", {push("chair", {{6.0, 0.0}})});
  ben.begin_s = 1.0;
  const auto result = Choreography::plan({person("anna", {sit("chair", 8.0)}), ben}, props(), 7);
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, ExitCode::kBadData);
  EXPECT_THAT(result.error().message,
              AllOf(HasSubstr("person 'ben', action 1 (push)"), HasSubstr("'anna' never leaves")));
}

}  // namespace
}  // namespace tsg::simulation
