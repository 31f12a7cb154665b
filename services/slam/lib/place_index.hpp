#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <unordered_set>
#include <vector>

#include "services/slam/lib/features.hpp"
#include "services/slam/lib/ids.hpp"

namespace tsg {

/// A keyframe that looks like what was asked for.
struct PlaceCandidate {
  KeyframeId keyframe = 0;
  int matches = 0;     ///< features of the query that look like one of this and of few keyframes
  double score = 0.0;  ///< sum over these of how much more alike they are than those of others
};

/// Finds the keyframes that show a view, by descriptors alone, without a vocabulary: several hash
/// tables, each over a fixed choice of bits, lead from a descriptor to those that agree in all of
/// a table's bits. Views of one place share many, others hardly any. A proposal only: places that
/// look alike are told apart by geometry (LoopVerifier).
/// Deterministic; not thread-safe: LocalMapper owns it.
class PlaceIndex {
 public:
  /// `max_keyframes` (1..65535) bounds the memory: with 1000 features about 50 kB a keyframe.
  explicit PlaceIndex(std::size_t max_keyframes);

  /// Where the index is full, every other keyframe leaves it first: its neighbours show the place.
  void add(KeyframeId id, std::shared_ptr<const Features> features);
  /// Takes a keyframe out; ids that are not there are ignored.
  void remove(KeyframeId id);

  /// Keyframes not in `exclude` that share at least `min_matches` features with the view; the best
  /// score first, the older first on a tie; at most kMaxCandidates. The further a score stands out
  /// from the others of the same answer, the more certain it is; for a new place none does.
  [[nodiscard]] std::vector<PlaceCandidate> query(const Features& features,
                                                  const std::unordered_set<KeyframeId>& exclude,
                                                  int min_matches) const;

  [[nodiscard]] std::size_t size() const { return slot_of_.size(); }
  /// What memory grows with; at most one per keyframe, feature and table.
  [[nodiscard]] std::size_t entry_count() const { return entry_count_; }

  static constexpr std::size_t kMaxCandidates = 10;
  static constexpr std::size_t kTables = 4;

 private:
  /// A descriptor in a bucket. The sketch, a quarter of its bits, settles most comparisons without
  /// a look at the rest. 12 bytes: there are millions.
  struct Entry {
    std::array<std::uint32_t, 2> sketch{};
    std::uint16_t slot = 0;
    std::uint16_t feature = 0;
  };
  struct Hash {
    std::array<std::uint32_t, 2> sketch{};
    std::array<std::uint16_t, kTables> keys{};
  };
  /// The closest feature of a keyframe to one of the query, as far as the tables show it.
  struct Hit {
    std::uint16_t slot = 0;
    std::uint16_t feature = 0;
    int distance = 0;  ///< of the sketches
  };
  struct Vote {
    std::uint32_t asked = 0;  ///< index in the query
    std::uint16_t slot = 0;
    std::uint16_t feature = 0;
    int weight = 0;
  };
  struct Slot {
    KeyframeId id = 0;
    std::shared_ptr<const Features> features;  ///< null where the slot is free
  };
  class Collector;

  [[nodiscard]] static Hash hash(const Descriptor& descriptor);
  [[nodiscard]] std::vector<Entry>& bucket(std::size_t table, const Hash& hash);
  void insert(std::vector<Entry>& bucket, const Entry& entry);
  [[nodiscard]] std::uint64_t priority(const Entry& entry) const;
  [[nodiscard]] std::vector<Vote> vote(const Features& features,
                                       const std::unordered_set<KeyframeId>& exclude) const;
  [[nodiscard]] std::vector<std::uint16_t> best_slots(const std::vector<Vote>& votes) const;
  [[nodiscard]] PlaceCandidate check(std::uint16_t slot,
                                     const Features& features,
                                     const std::vector<Vote>& votes) const;
  void thin_out();

  std::size_t max_keyframes_;
  std::vector<Slot> slots_;
  std::vector<std::uint16_t> free_;
  std::map<KeyframeId, std::uint16_t> slot_of_;
  std::vector<std::vector<Entry>> buckets_;  ///< table after table
  std::size_t entry_count_ = 0;
};

}  // namespace tsg
