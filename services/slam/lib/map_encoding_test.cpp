#include "services/slam/lib/map_encoding.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <random>

#include "services/slam/lib/synthetic_session.hpp"

namespace tsg {
namespace {

using synthetic::map_with_everything;
using ::testing::HasSubstr;

/// What is said of a map that `spoil` has changed.
std::string refusal(const std::function<void(MapContents&)>& spoil) {
  MapContents contents = map_with_everything();
  spoil(contents);
  const auto decoded =
      decode_map(encode_map(contents), contents.camera, {.levels = 8, .scale_factor = 1.2});
  if (decoded) return "it was accepted";
  EXPECT_EQ(decoded.error().code, ExitCode::kBadData);
  return decoded.error().message;
}

/// A map that was accepted must be one that a mapper can work with.
void use(const MapContents& contents) {
  LocalMapper mapper(SlamConfig{}, MapContents(contents));
  EXPECT_FALSE(mapper.snapshot()->keyframes.empty());
  EXPECT_GE(mapper.keyframe_poses().size(), contents.keyframes.size());
}

TEST(MapEncoding, NothingThatContradictsItselfIsAccepted) {
  const auto nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(refusal([](MapContents& map) { map.keyframes.clear(); }), HasSubstr("no keyframe"));
  EXPECT_THAT(refusal([](MapContents& map) { std::swap(map.points[0], map.points[1]); }),
              HasSubstr("out of order"));
  EXPECT_THAT(refusal([](MapContents& map) { std::swap(map.keyframes[0], map.keyframes[1]); }),
              HasSubstr("out of order"));
  EXPECT_THAT(refusal([](MapContents& map) { map.next_point = 1; }), HasSubstr("not given"));
  EXPECT_THAT(refusal([](MapContents& map) { map.newest += 1; }), HasSubstr("newest"));
  EXPECT_THAT(refusal([](MapContents& map) { map.loops[0].a = 99'999; }), HasSubstr("loop"));
  EXPECT_THAT(refusal([](MapContents& map) { map.recent_points = {map.next_point}; }),
              HasSubstr("on trial"));
  EXPECT_THAT(refusal([&](MapContents& map) { map.points[5].position.y() = nan; }),
              HasSubstr("no place"));
}

TEST(MapEncoding, NoObservationLeadsAstray) {
  const auto first = [](MapContents& map) -> Observation& { return map.points[0].observations[0]; };
  EXPECT_THAT(refusal([](MapContents& map) { map.points[0].observations.back().keyframe = 5000; }),
              HasSubstr("not there"));
  EXPECT_THAT(refusal([&](MapContents& map) { first(map).feature = -1; }), HasSubstr("feature"));
  EXPECT_THAT(refusal([&](MapContents& map) { first(map).feature = 15'000; }),
              HasSubstr("feature"));
  EXPECT_THAT(refusal([&](MapContents& map) { map.points[1].observations[0] = first(map); }),
              HasSubstr("shares a feature"));
  EXPECT_THAT(refusal([&](MapContents& map) {
                const auto feature = static_cast<std::size_t>(first(map).feature);
                for (Keyframe& keyframe : map.keyframes) keyframe.banned[feature] = true;
              }),
              HasSubstr("dynamic"));
  EXPECT_THAT(refusal([&](MapContents& map) { map.points[0].observations.clear(); }),
              HasSubstr("no keyframe"));
  EXPECT_THAT(refusal([&](MapContents& map) {
                map.points[0].observations.push_back(map.points[0].observations[0]);
              }),
              HasSubstr("out of order"));
}

TEST(MapEncoding, PartsThatNobodyBeganOrThatShareAPointAreRefused) {
  EXPECT_THAT(refusal([](MapContents& map) { map.keyframes.back().part = 77'777; }),
              HasSubstr("lacks the keyframe that began it"));
  EXPECT_THAT(refusal([](MapContents& map) {
                map.keyframes.back().part = part_begun_by(map.keyframes.back().id);
              }),
              HasSubstr("two parts of the map"));
}

TEST(MapEncoding, CulledKeyframesThatLeadNowhereOrInACircleAreRefused) {
  EXPECT_THAT(refusal([](MapContents& map) { map.culled.begin()->second.parent = 77'777; }),
              HasSubstr("leads nowhere"));
  EXPECT_THAT(refusal([](MapContents& map) {
                map.culled.rbegin()->second.parent = map.culled.begin()->first;
              }),
              HasSubstr("leads nowhere"));
  EXPECT_THAT(refusal([](MapContents& map) { map.culled[map.newest] = {}; }),
              HasSubstr("leads nowhere"));
}

TEST(MapEncoding, FeaturesThatCannotBeAreRefused) {
  const auto spoilt = [](const std::function<void(Features&)>& spoil) {
    return refusal([&](MapContents& map) {
      auto features = std::make_shared<Features>(*map.keyframes[0].features);
      spoil(*features);
      map.keyframes[0].features = features;
    });
  };
  const float infinite = std::numeric_limits<float>::infinity();
  EXPECT_THAT(spoilt([](Features& f) { f.items[3].level = 8; }), HasSubstr("pyramid"));
  EXPECT_THAT(spoilt([](Features& f) { f.items[3].raw_x = 640; }), HasSubstr("outside"));
  EXPECT_THAT(spoilt([](Features& f) { f.items[3].raw_y = -1; }), HasSubstr("outside"));
  EXPECT_THAT(spoilt([&](Features& f) { f.items[3].pixel.x() = infinite; }), HasSubstr("outside"));
  EXPECT_THAT(spoilt([](Features& f) { f.items[3].inverse_depth = -1.0F; }), HasSubstr("depth"));
  EXPECT_THAT(spoilt([&](Features& f) { f.surface.inverse_depths[9] = infinite; }),
              HasSubstr("depth"));
  EXPECT_THAT(spoilt([](Features& f) { f.surface.columns += 1; }), HasSubstr("surface"));
  EXPECT_THAT(spoilt([](Features& f) { f.items[3].verdict = static_cast<FeatureVerdict>(3); }),
              HasSubstr("outside"));
}

/// Damage that a checksum does not see, as if somebody had made it on purpose.
TEST(MapEncoding, NoBytesWhateverBringTheReaderDown) {
  const MapContents contents = map_with_everything();
  const std::string good = encode_map(contents);
  const MapFeatureSettings settings{.levels = 8, .scale_factor = 1.2};
  std::mt19937 generator(20261122);
  for (int i = 0; i < 60; ++i) {
    const std::size_t at = generator() % good.size();
    std::string cut = good.substr(0, at);
    EXPECT_FALSE(decode_map(cut, contents.camera, settings)) << "cut at " << at;
    std::string changed = good;
    for (std::size_t k = at; k < std::min(at + 8, good.size()); ++k) {
      changed[k] = static_cast<char>(generator());
    }
    const auto decoded = decode_map(changed, contents.camera, settings);
    if (decoded) use(*decoded);
  }
  for (std::size_t at = 0; at < 64; ++at) {  // where the counts are
    std::string changed = good;
    changed[at] = static_cast<char>(0xff);
    const auto decoded = decode_map(changed, contents.camera, settings);
    if (decoded) use(*decoded);
  }
}

}  // namespace
}  // namespace tsg
