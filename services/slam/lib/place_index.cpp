#include "services/slam/lib/place_index.hpp"

#include <algorithm>
#include <bit>
#include <limits>
#include <numeric>
#include <random>

#include "common/core/check.hpp"

namespace tsg {
namespace {

constexpr std::size_t kKeyBits = 14;
constexpr std::size_t kBuckets = std::size_t{1} << kKeyBits;  // of one table
constexpr int kMaxSketchDistance = 15;     // of 64; one feature from two views: 8 on average
constexpr std::size_t kMaxNearest = 10;    // keyframes that a feature votes for ...
constexpr std::size_t kNearestShare = 10;  // ... and at most one in so many
constexpr int kMaxVoteDistance = 60;       // of 256; chance meetings are mostly farther apart
constexpr std::size_t kMaxBucket = 256;    // bounds time and memory where descriptors are all alike
constexpr unsigned kBitsSeed = 4711;       // any; which bits are chosen does not matter much

/// The bits of a descriptor in a fixed random order: sketch first, then table after table. No bit
/// serves twice, so that agreement in one table says something new about the others.
const std::array<std::uint8_t, 256>& bit_order() {
  static const std::array<std::uint8_t, 256> kOrder = [] {
    std::array<std::uint8_t, 256> order{};
    std::iota(order.begin(), order.end(), std::uint8_t{0});
    std::mt19937 generator(kBitsSeed);
    // std::shuffle may differ between standard libraries; this does not.
    for (std::size_t i = order.size() - 1; i > 0; --i) {
      std::swap(order[i], order[generator() % (i + 1)]);
    }
    return order;
  }();
  return kOrder;
}

/// Bits `first` .. `first + count` of the order, as a number.
std::uint32_t pick_bits(const Descriptor& descriptor, std::size_t first, std::size_t count) {
  std::uint32_t value = 0;
  for (std::size_t i = first; i < first + count; ++i) {
    const std::uint8_t bit = bit_order()[i];
    value = (value << 1U) | static_cast<std::uint32_t>((descriptor[bit / 64U] >> (bit % 64U)) & 1U);
  }
  return value;
}

int distance(const std::array<std::uint32_t, 2>& a, const std::array<std::uint32_t, 2>& b) {
  return std::popcount(a[0] ^ b[0]) + std::popcount(a[1] ^ b[1]);
}

}  // namespace

/// Gathers what one feature of a query meets: of each keyframe the closest.
class PlaceIndex::Collector {
 public:
  explicit Collector(const std::vector<Slot>& slots, const std::unordered_set<KeyframeId>& exclude)
      : place_of_slot_(slots.size(), kNowhere) {
    for (std::size_t slot = 0; slot < slots.size(); ++slot) {
      if (exclude.contains(slots[slot].id)) place_of_slot_[slot] = kExcluded;
    }
  }

  void look_through(const std::vector<Entry>& bucket, const Hash& hash) {
    for (const Entry& entry : bucket) {
      const int far = distance(entry.sketch, hash.sketch);
      if (far > kMaxSketchDistance) continue;
      std::int32_t& place = place_of_slot_[entry.slot];
      if (place == kExcluded) continue;
      if (place == kNowhere) {
        place = static_cast<std::int32_t>(hits_.size());
        hits_.push_back({entry.slot, entry.feature, far});
      } else if (Hit& hit = hits_[static_cast<std::size_t>(place)]; far < hit.distance) {
        hit = {entry.slot, entry.feature, far};
      }
    }
  }
  [[nodiscard]] const std::vector<Hit>& hits() const { return hits_; }

  /// Distance of the first keyframe after the `nearest`; farther than any hit if there is none.
  [[nodiscard]] int background(std::size_t nearest) const {
    std::array<std::size_t, kMaxSketchDistance + 1> counts{};
    for (const Hit& hit : hits_) ++counts[static_cast<std::size_t>(hit.distance)];
    std::size_t nearer = 0;
    for (std::size_t far = 0; far < counts.size(); ++far) {
      nearer += counts[far];
      if (nearer > nearest) return static_cast<int>(far);
    }
    return kMaxSketchDistance + 1;
  }

  void clear() {
    for (const Hit& hit : hits_) place_of_slot_[hit.slot] = kNowhere;
    hits_.clear();
  }

 private:
  static constexpr std::int32_t kNowhere = -1;
  static constexpr std::int32_t kExcluded = -2;
  std::vector<std::int32_t> place_of_slot_;  ///< in hits_
  std::vector<Hit> hits_;
};

PlaceIndex::PlaceIndex(std::size_t max_keyframes)
    : max_keyframes_(max_keyframes), buckets_(kTables * kBuckets) {
  TSG_CHECK(max_keyframes >= 1 && max_keyframes <= std::numeric_limits<std::uint16_t>::max());
}

PlaceIndex::Hash PlaceIndex::hash(const Descriptor& descriptor) {
  Hash hash{.sketch = {pick_bits(descriptor, 0, 32), pick_bits(descriptor, 32, 32)}};
  for (std::size_t table = 0; table < kTables; ++table) {
    hash.keys[table] =
        static_cast<std::uint16_t>(pick_bits(descriptor, 64 + table * kKeyBits, kKeyBits));
  }
  return hash;
}

std::vector<PlaceIndex::Entry>& PlaceIndex::bucket(std::size_t table, const Hash& hash) {
  return buckets_[table * kBuckets + hash.keys[table]];
}

void PlaceIndex::add(KeyframeId id, std::shared_ptr<const Features> features) {
  TSG_CHECK(!slot_of_.contains(id) && features->size() <= kBuckets);
  if (slot_of_.size() >= max_keyframes_) thin_out();
  if (free_.empty()) {
    free_.push_back(static_cast<std::uint16_t>(slots_.size()));
    slots_.emplace_back();
  }
  const std::uint16_t slot = free_.back();
  free_.pop_back();
  slots_[slot] = {id, std::move(features)};
  slot_of_[id] = slot;
  const std::vector<Descriptor>& descriptors = slots_[slot].features->descriptors;
  for (std::size_t i = 0; i < descriptors.size(); ++i) {
    const Hash hashed = hash(descriptors[i]);
    for (std::size_t table = 0; table < kTables; ++table) {
      insert(bucket(table, hashed), {hashed.sketch, slot, static_cast<std::uint16_t>(i)});
    }
  }
}

std::uint64_t PlaceIndex::priority(const Entry& entry) const {
  // The finaliser of SplitMix64 (Steele et al. 2014): neighbours get unlike numbers.
  std::uint64_t value = (slots_[entry.slot].id << 16U) | entry.feature;
  value = (value ^ (value >> 30U)) * 0xbf58476d1ce4e5b9ULL;
  value = (value ^ (value >> 27U)) * 0x94d049bb133111ebULL;
  return value ^ (value >> 31U);
}

/// A full bucket keeps a fair sample of what came: neither the old nor the new have precedence.
void PlaceIndex::insert(std::vector<Entry>& bucket, const Entry& entry) {
  if (bucket.size() < kMaxBucket) {
    bucket.push_back(entry);
    ++entry_count_;
    return;
  }
  const auto least = std::min_element(
      bucket.begin(), bucket.end(),
      [this](const Entry& a, const Entry& b) { return priority(a) < priority(b); });
  if (priority(*least) < priority(entry)) *least = entry;
}

void PlaceIndex::remove(KeyframeId id) {
  const auto place = slot_of_.find(id);
  if (place == slot_of_.end()) return;
  const std::uint16_t slot = place->second;
  const auto is_leaving = [slot](const Entry& entry) { return entry.slot == slot; };
  for (const Descriptor& descriptor : slots_[slot].features->descriptors) {
    const Hash hashed = hash(descriptor);
    for (std::size_t table = 0; table < kTables; ++table) {
      entry_count_ -= std::erase_if(bucket(table, hashed), is_leaving);
    }
  }
  slots_[slot] = {};
  free_.push_back(slot);
  slot_of_.erase(place);
}

void PlaceIndex::thin_out() {
  std::vector<KeyframeId> leaving;
  std::size_t i = 0;
  for (const auto& [id, slot] : slot_of_) {
    if (i++ % 2 == 0) leaving.push_back(id);
  }
  for (const KeyframeId id : leaving) remove(id);
}

/// Each feature votes for the keyframes that have the most similar ones, by how much more similar
/// they are than that of the next (local naive-Bayes nearest neighbours, McCann and Lowe 2012):
/// what looks the same everywhere has no say.
std::vector<PlaceIndex::Vote> PlaceIndex::vote(
    const Features& features, const std::unordered_set<KeyframeId>& exclude) const {
  std::vector<Vote> votes;
  Collector collector(slots_, exclude);
  const auto nearest = std::clamp(size() / kNearestShare, std::size_t{1}, kMaxNearest);
  for (std::size_t i = 0; i < features.size(); ++i) {
    const Hash hashed = hash(features.descriptors[i]);
    for (std::size_t table = 0; table < kTables; ++table) {
      collector.look_through(buckets_[table * kBuckets + hashed.keys[table]], hashed);
    }
    const int background = collector.background(nearest);
    for (const Hit& hit : collector.hits()) {
      if (hit.distance >= background) continue;
      votes.push_back(
          {static_cast<std::uint32_t>(i), hit.slot, hit.feature, background - hit.distance});
    }
    collector.clear();
  }
  return votes;
}

std::vector<std::uint16_t> PlaceIndex::best_slots(const std::vector<Vote>& votes) const {
  std::vector<int> weights(slots_.size());
  for (const Vote& vote : votes) weights[vote.slot] += vote.weight;
  std::vector<std::uint16_t> slots;
  for (std::size_t slot = 0; slot < weights.size(); ++slot) {
    if (weights[slot] > 0) slots.push_back(static_cast<std::uint16_t>(slot));
  }
  const auto count = std::min(slots.size(), kMaxCandidates);
  std::partial_sort(slots.begin(), slots.begin() + static_cast<std::ptrdiff_t>(count), slots.end(),
                    [&](std::uint16_t a, std::uint16_t b) {
                      if (weights[a] != weights[b]) return weights[a] > weights[b];
                      return slots_[a].id < slots_[b].id;
                    });
  slots.resize(count);
  return slots;
}

/// Counts the votes for a keyframe that whole descriptors confirm.
PlaceCandidate PlaceIndex::check(std::uint16_t slot,
                                 const Features& features,
                                 const std::vector<Vote>& votes) const {
  const std::vector<Descriptor>& theirs = slots_[slot].features->descriptors;
  PlaceCandidate candidate{.keyframe = slots_[slot].id};
  for (const Vote& vote : votes) {
    if (vote.slot != slot) continue;
    const Descriptor& asked = features.descriptors[vote.asked];
    if (hamming_distance(asked, theirs[vote.feature]) > kMaxVoteDistance) continue;
    ++candidate.matches;
    candidate.score += vote.weight;
  }
  return candidate;
}

std::vector<PlaceCandidate> PlaceIndex::query(const Features& features,
                                              const std::unordered_set<KeyframeId>& exclude,
                                              int min_matches) const {
  const std::vector<Vote> votes = vote(features, exclude);
  std::vector<PlaceCandidate> candidates;
  for (const std::uint16_t slot : best_slots(votes)) {
    const PlaceCandidate candidate = check(slot, features, votes);
    if (candidate.matches >= min_matches) candidates.push_back(candidate);
  }
  std::sort(candidates.begin(), candidates.end(), [](const auto& a, const auto& b) {
    return a.score != b.score ? a.score > b.score : a.keyframe < b.keyframe;
  });
  return candidates;
}

}  // namespace tsg
