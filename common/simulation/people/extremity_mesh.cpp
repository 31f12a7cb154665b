#include <algorithm>
#include <array>
#include <cmath>

#include "common/simulation/people/body_mesh.hpp"
#include "common/simulation/people/easing.hpp"
#include "common/simulation/people/loft.hpp"

namespace tsg::simulation {
namespace {

/// Axes of a hand at rest: fingers along `down`, thumb in front, palm towards the body.
struct HandAxes {
  Eigen::Vector3f wrist_m;
  Eigen::Vector3f down;
  Eigen::Vector3f ahead = Eigen::Vector3f::UnitX();
  Eigen::Vector3f left;  ///< whichever hand it is
  Eigen::Vector3f palm;  ///< where it looks
  float scale;
  Skin skin;

  [[nodiscard]] Eigen::Vector3f at(float down_m, float ahead_m, float palm_m) const {
    return wrist_m + scale * (down_m * down + ahead_m * ahead + palm_m * palm);
  }
};

struct Finger {
  float ahead;   ///< where it grows from the palm
  float begins;  ///< how far down
  float length;
  float radius;
  float spread;  ///< how far ahead its tip goes
};

void add_finger(const HandAxes& hand, const Finger& finger, SkinnedMesh& mesh) {
  constexpr int kJoints = 3;
  std::vector<Ring> rings;
  for (int i = kJoints; i >= 0; --i) {
    const float along = static_cast<float>(i) / kJoints;
    const float radius = hand.scale * finger.radius * (1.0F - 0.25F * along);
    // Fingers of a hand at rest curl towards the palm.
    const Eigen::Vector3f centre =
        hand.at(finger.begins + finger.length * along * (1.0F - 0.12F * along),
                finger.ahead + finger.spread * along, 0.030F * along * along);
    rings.push_back({centre, radius, radius, radius, hand.skin});
  }
  TubeStyle style;
  style.sides = 6;
  style.depth = hand.ahead;
  style.side = hand.left;
  style.material = material_of(BodyMaterial::kSkin);
  add_tube(mesh, rings, style);
}

}  // namespace

void add_hand(const Skeleton& skeleton, Side side, SkinnedMesh& mesh) {
  HandAxes hand;
  hand.scale = static_cast<float>(skeleton.scale);
  hand.wrist_m = skeleton.joint(side, LimbBone::kHand).cast<float>();
  hand.down = rest_arm_direction(side).cast<float>();
  hand.left = (-hand.down).cross(hand.ahead);
  hand.palm = static_cast<float>(-sign_of(side)) * hand.left;
  hand.skin = skin_of(index_of(side, LimbBone::kHand));
  const Skin wrist =
      skin_between(index_of(side, LimbBone::kLowerArm), index_of(side, LimbBone::kHand), 0.4F);
  const auto ring = [&](float down, float thin, float wide, const Skin& skin) {
    return Ring{hand.at(down, 0.0F, 0.0F),
                hand.scale * thin,
                hand.scale * wide,
                hand.scale * wide,
                skin,
                2.4F};
  };
  TubeStyle style;
  style.sides = 12;
  style.depth = hand.ahead;
  style.side = hand.left;
  style.material = material_of(BodyMaterial::kSkin);
  add_tube(mesh,
           {ring(0.098F, 0.011F, 0.038F, hand.skin), ring(0.075F, 0.014F, 0.042F, hand.skin),
            ring(0.045F, 0.016F, 0.040F, hand.skin), ring(0.018F, 0.017F, 0.032F, hand.skin),
            ring(-0.01F, 0.020F, 0.028F, wrist),
            ring(-0.04F, 0.021F, 0.028F, skin_of(index_of(side, LimbBone::kLowerArm)))},
           style);
  constexpr std::array<Finger, 5> kFingers{{{0.031F, 0.090F, 0.072F, 0.0095F, 0.004F},
                                            {0.010F, 0.095F, 0.080F, 0.0098F, 0.001F},
                                            {-0.011F, 0.092F, 0.074F, 0.0093F, -0.002F},
                                            {-0.030F, 0.085F, 0.058F, 0.0082F, -0.006F},
                                            {0.026F, 0.022F, 0.062F, 0.0115F, 0.040F}}};
  for (const Finger& finger : kFingers) add_finger(hand, finger, mesh);
}

void add_shoe(const Skeleton& skeleton, Side side, SkinnedMesh& mesh) {
  struct Slice {
    float x;
    float half_width;
    float up;
  };
  constexpr std::array<Slice, 11> kSlices{{{-0.070F, 0.024F, 0.040F},
                                           {-0.055F, 0.034F, 0.058F},
                                           {-0.025F, 0.039F, 0.068F},
                                           {0.010F, 0.040F, 0.074F},
                                           {0.045F, 0.041F, 0.056F},
                                           {0.080F, 0.044F, 0.038F},
                                           {0.115F, 0.047F, 0.026F},
                                           {0.145F, 0.047F, 0.019F},
                                           {0.170F, 0.043F, 0.014F},
                                           {0.190F, 0.032F, 0.009F},
                                           {0.202F, 0.016F, 0.004F}}};
  constexpr float kMiddle = 0.030F;  // height of the widest part above the floor
  const auto scale = static_cast<float>(skeleton.scale);
  const auto y = static_cast<float>(skeleton.joint(side, LimbBone::kFoot).y());
  const float inwards = static_cast<float>(-sign_of(side)) * scale;
  std::vector<Ring> rings;
  for (const Slice& slice : kSlices) {
    const auto share = static_cast<float>(eased((slice.x - 0.09) / 0.06));
    const float bend = 0.006F * std::sin(20.0F * slice.x);  // a shoe is not straight
    rings.push_back(
        {{scale * slice.x, y + inwards * bend, scale * kMiddle},
         scale * slice.half_width,
         scale * slice.up,
         1.4F * scale * kMiddle,
         skin_between(index_of(side, LimbBone::kFoot), index_of(side, LimbBone::kToes), share),
         2.6F});
  }
  TubeStyle style;
  style.depth = Eigen::Vector3f::UnitZ();
  style.side = -Eigen::Vector3f::UnitY();
  style.sides = 18;
  style.material = material_of(BodyMaterial::kShoes);
  style.texture_height_m = 0.3F * scale;
  const std::size_t first = add_tube(mesh, rings, style);
  for (std::size_t i = first; i < mesh.rest.points.size(); ++i) {
    mesh.rest.points[i].z() = std::max(mesh.rest.points[i].z(), 0.0F);  // a flat sole
  }
}

}  // namespace tsg::simulation
