#include "services/slam/lib/feature_matcher.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "services/slam/lib/observation_model.hpp"
#include "services/slam/lib/synthetic_scene.hpp"

namespace tsg {
namespace {

Descriptor random_descriptor(std::mt19937_64& generator) {
  return {generator(), generator(), generator(), generator()};
}

/// Features at random pixels with random looks.
Features random_features(unsigned seed, std::size_t count) {
  std::mt19937_64 generator(seed);
  Features features;
  for (std::size_t i = 0; i < count; ++i) {
    Feature feature;
    feature.pixel = {static_cast<float>(generator() % 640), static_cast<float>(generator() % 480)};
    feature.inverse_depth = 0.5F;
    feature.level = 2;
    features.items.push_back(feature);
    features.descriptors.push_back(random_descriptor(generator));
  }
  features.grid = FeatureGrid(features.items, 640, 480);
  return features;
}

MatchTarget target_at(const Features& features, std::size_t i) {
  return {.source = static_cast<int>(i),
          .pixel = features.items[i].pixel + Eigen::Vector2f(3.0F, -2.0F),
          .radius = 5.0F,
          .inverse_depth = 0.5F,
          .max_depth_error = 0.05F,
          .min_level = 1,
          .max_level = 3,
          .descriptor = &features.descriptors[i]};
}

TEST(MatchByProjection, FindsEachTargetNearItsPlace) {
  const Features features = random_features(1, 300);
  std::vector<MatchTarget> targets;
  for (std::size_t i = 0; i < features.size(); ++i) targets.push_back(target_at(features, i));
  const auto matches = match_by_projection(features, targets, {}, {});
  ASSERT_EQ(matches.size(), features.size());
  for (const FeatureMatch& match : matches) EXPECT_EQ(match.source, match.feature);
}

TEST(MatchByProjection, PassesOverWhatIsFarOrOfAnotherScaleOrDepthOrTaken) {
  const Features features = random_features(2, 1);
  const MatchTarget good = target_at(features, 0);
  MatchTarget far = good;
  far.pixel.x() += 10.0F;
  MatchTarget coarse = good;
  coarse.min_level = 3;
  MatchTarget behind = good;
  behind.inverse_depth = 0.4F;
  EXPECT_EQ(match_by_projection(features, {good}, {}, {}).size(), 1U);
  EXPECT_TRUE(match_by_projection(features, {far}, {}, {}).empty());
  EXPECT_TRUE(match_by_projection(features, {coarse}, {}, {}).empty());
  EXPECT_TRUE(match_by_projection(features, {behind}, {}, {}).empty());
  EXPECT_TRUE(match_by_projection(features, {good}, {true}, {}).empty());
}

TEST(MatchByProjection, GivesAFeatureToTheTargetThatLooksMostLikeIt) {
  const Features features = random_features(3, 1);
  Descriptor similar = features.descriptors[0];
  similar[0] ^= 0xFF;
  MatchTarget worse = target_at(features, 0);
  worse.descriptor = &similar;
  MatchTarget better = target_at(features, 0);
  better.source = 7;
  const auto matches = match_by_projection(features, {worse, better}, {}, {});
  ASSERT_EQ(matches.size(), 1U);
  EXPECT_EQ(matches[0].source, 7);
}

TEST(MatchByProjection, RefusesWhatTwoFeaturesFitEquallyWell) {
  Features features = random_features(4, 2);
  features.items[1].pixel = features.items[0].pixel + Eigen::Vector2f(1.0F, 0.0F);
  features.descriptors[1] = features.descriptors[0];
  features.descriptors[1][0] ^= 1;
  features.grid = FeatureGrid(features.items, 640, 480);
  Descriptor between = features.descriptors[0];
  between[1] ^= 0xFFFF;
  MatchTarget target = target_at(features, 0);
  target.descriptor = &between;
  EXPECT_TRUE(match_by_projection(features, {target}, {}, {.max_ratio = 0.9F}).empty());
  EXPECT_EQ(match_by_projection(features, {target}, {}, {.max_ratio = 1.0F}).size(), 1U);
}

TEST(MatchByDescriptor, FindsTheSameLooksAnywhere) {
  const Features from = random_features(5, 200);
  Features to = from;
  for (Feature& feature : to.items) feature.pixel = {1.0F, 1.0F};
  std::vector<bool> usable(from.size(), true);
  usable[3] = false;
  const auto matches =
      match_by_descriptor(from, usable, to, {.max_distance = 50, .max_ratio = 0.8F});
  EXPECT_EQ(matches.size(), from.size() - 1);
  for (const FeatureMatch& match : matches) EXPECT_EQ(match.source, match.feature);
}

TEST(KeepConsistentRotations, DropsTheFewThatTurnOtherwise) {
  std::vector<FeatureMatch> matches;
  for (int i = 0; i < 90; ++i) matches.push_back({.source = i, .rotation = 0.5F});
  for (int i = 0; i < 5; ++i) matches.push_back({.source = 100 + i, .rotation = -1.0F});
  keep_consistent_rotations(matches);
  EXPECT_EQ(matches.size(), 90U);
  EXPECT_THAT(matches, testing::Each(testing::Field(&FeatureMatch::rotation, 0.5F)));
}

TEST(FeatureGrid, VisitsAllThatIsInTheSquareAndNothingTwice) {
  const Features features = random_features(6, 1000);
  for (const Eigen::Vector2f& centre :
       {Eigen::Vector2f(320.0F, 240.0F), Eigen::Vector2f(2.0F, 478.0F)}) {
    std::vector<int> visited;
    features.grid.for_each_near(centre, 30.0F, [&](int i) { visited.push_back(i); });
    std::sort(visited.begin(), visited.end());
    EXPECT_EQ(std::adjacent_find(visited.begin(), visited.end()), visited.end());
    for (std::size_t i = 0; i < features.size(); ++i) {
      if ((features.items[i].pixel - centre).cwiseAbs().maxCoeff() > 30.0F) continue;
      EXPECT_TRUE(std::binary_search(visited.begin(), visited.end(), static_cast<int>(i)));
    }
  }
}

}  // namespace
}  // namespace tsg
