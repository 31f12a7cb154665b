#include "common/simulation/people/look.hpp"

#include <array>

#include "common/simulation/random.hpp"

namespace tsg::simulation {
namespace {

/// BGR from the usual 0xRRGGBB.
cv::Vec3b colour(unsigned rgb) {
  return {static_cast<unsigned char>(rgb & 0xFFU), static_cast<unsigned char>((rgb >> 8U) & 0xFFU),
          static_cast<unsigned char>((rgb >> 16U) & 0xFFU)};
}

template <std::size_t N>
cv::Vec3b pick(Random& random, const std::array<unsigned, N>& colours) {
  return colour(colours.at(static_cast<std::size_t>(random.integer(0, static_cast<int>(N) - 1))));
}

constexpr std::array<unsigned, 6> kSkins{0xE8BFA2, 0xDDAA86, 0xC68E68,
                                         0xA06A45, 0x7A4B30, 0xEBC9B2};
constexpr std::array<unsigned, 7> kHairs{0x1E1713, 0x33231A, 0x4E3422, 0x76502E,
                                         0xB08A54, 0x8A8580, 0x5E2C19};
constexpr std::array<unsigned, 4> kEyes{0x4A3020, 0x3E5E78, 0x4F6B45, 0x2C2018};
constexpr std::array<unsigned, 8> kBright{0xC8403A, 0x2F6DB0, 0x3C8A5A, 0xE0A93B,
                                          0x7B4B94, 0xD9D4C8, 0x2D8C93, 0xC9683C};
constexpr std::array<unsigned, 6> kDark{0x27324A, 0x3A2B2B, 0x22372F, 0x4A4A50, 0x3B2746, 0x2B2B2E};
constexpr std::array<unsigned, 4> kPale{0xEFEAE0, 0xD5DCE4, 0xE8D9B8, 0xC7CDC2};
constexpr std::array<unsigned, 3> kDenims{0x35507A, 0x26334F, 0x5E7EA6};
constexpr std::array<unsigned, 5> kTrousers{0x8E7A5C, 0x46484C, 0x6B6F57, 0x2A2C33, 0xB5A88C};
constexpr std::array<unsigned, 5> kShoes{0x2A2522, 0x6B4426, 0xE2DFD8, 0x32466B, 0x8C2F2C};

Cloth make_top_cloth(Random& random) {
  static constexpr std::array<Pattern, 8> kPatterns{
      Pattern::kChecks, Pattern::kStripes, Pattern::kPrint, Pattern::kDiamonds,
      Pattern::kBlocks, Pattern::kPlain,   Pattern::kDots,  Pattern::kKnit};
  Cloth cloth;
  cloth.pattern = kPatterns.at(static_cast<std::size_t>(random.integer(0, 7)));
  const bool is_dark = random.chance(0.4);
  cloth.ground = is_dark ? pick(random, kDark) : pick(random, kBright);
  cloth.accent = is_dark ? pick(random, kBright) : pick(random, kPale);
  cloth.second = is_dark ? pick(random, kPale) : pick(random, kDark);
  cloth.seed = random.next();
  return cloth;
}

Cloth make_bottom_cloth(Random& random) {
  Cloth cloth;
  cloth.pattern = random.chance(0.6) ? Pattern::kDenim : Pattern::kPlain;
  cloth.ground = cloth.pattern == Pattern::kDenim ? pick(random, kDenims) : pick(random, kTrousers);
  cloth.accent = pick(random, kPale);
  cloth.second = pick(random, kDark);
  cloth.seed = random.next();
  return cloth;
}

}  // namespace

Look make_look(std::uint64_t seed) {
  Random random(mixed(seed + 0x5E0));
  Look look;
  look.seed = seed;
  look.is_feminine = random.chance(0.5);
  look.skin = pick(random, kSkins);
  look.hair_colour = pick(random, kHairs);
  look.eyes = pick(random, kEyes);
  look.shoes = pick(random, kShoes);
  look.top = static_cast<Top>(random.integer(0, 3));
  look.top_cloth = make_top_cloth(random);
  look.bottom_cloth = make_bottom_cloth(random);
  look.has_glasses = random.chance(0.3);
  look.girth = random.uniform(0.93, 1.1);
  if (look.is_feminine) {
    look.hair = std::array{Hair::kBob, Hair::kLong, Hair::kBun}.at(
        static_cast<std::size_t>(random.integer(0, 2)));
    if (random.chance(0.35)) look.bottom = Bottom::kSkirt;
    look.shoulder_width = 0.91;
    look.hip_width = 1.03;
    look.girth *= 0.94;
  } else {
    look.hair = random.chance(0.7) ? Hair::kShort : Hair::kCropped;
    look.has_beard = random.chance(0.35);
  }
  if (look.bottom == Bottom::kSkirt) look.bottom_cloth.pattern = make_top_cloth(random).pattern;
  return look;
}

}  // namespace tsg::simulation
