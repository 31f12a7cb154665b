#include "common/dataset/association.hpp"

#include <algorithm>
#include <cstdlib>

namespace tsg {
namespace {

struct Candidate {
  std::int64_t difference_ns;
  StampPair pair;
};

std::vector<Candidate> candidates_within(std::span<const std::int64_t> first,
                                         std::span<const std::int64_t> second,
                                         std::int64_t max_difference_ns) {
  std::vector<Candidate> candidates;
  std::size_t begin = 0;
  for (std::size_t i = 0; i < first.size(); ++i) {
    while (begin < second.size() && second[begin] < first[i] - max_difference_ns) ++begin;
    for (std::size_t j = begin; j < second.size(); ++j) {
      if (second[j] > first[i] + max_difference_ns) break;
      candidates.push_back({std::abs(second[j] - first[i]), {i, j}});
    }
  }
  return candidates;
}

}  // namespace

std::vector<StampPair> associate(std::span<const std::int64_t> first,
                                 std::span<const std::int64_t> second,
                                 std::int64_t max_difference_ns) {
  std::vector<Candidate> candidates = candidates_within(first, second, max_difference_ns);
  // Stable: among equal differences the earlier stamps, which come first, win.
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const auto& a, const auto& b) { return a.difference_ns < b.difference_ns; });
  std::vector<bool> first_used(first.size(), false);
  std::vector<bool> second_used(second.size(), false);
  std::vector<StampPair> pairs;
  for (const Candidate& candidate : candidates) {
    const StampPair& pair = candidate.pair;
    if (first_used[pair.first] || second_used[pair.second]) continue;
    first_used[pair.first] = true;
    second_used[pair.second] = true;
    pairs.push_back(pair);
  }
  std::sort(pairs.begin(), pairs.end(),
            [](const StampPair& a, const StampPair& b) { return a.first < b.first; });
  return pairs;
}

}  // namespace tsg
