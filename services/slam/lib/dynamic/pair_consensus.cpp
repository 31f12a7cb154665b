#include "services/slam/lib/dynamic/pair_consensus.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace tsg {
namespace {

constexpr int kMaxRefits = 5;  // they settle after two or three
constexpr unsigned kSeed = 1;

/// A relation and how well it explains the pairs.
struct Scored {
  Consensus consensus;
  double cost = std::numeric_limits<double>::infinity();  ///< pixels squared
};

class ConsensusSearch {
 public:
  ConsensusSearch(const PairModel& model,
                  std::span<const PixelPair> pairs,
                  const ConsensusLimits& limits)
      : model_(model), pairs_(pairs), limits_(limits), generator_(kSeed) {}

  std::optional<Consensus> run() {
    int samples = limits_.max_samples;
    for (int i = 0; i < samples; ++i) {
      draw();
      const auto found = model_.fit(sample_);
      if (!found) continue;
      const double cost = cost_below(best_.cost, *found);
      if (cost >= best_.cost) continue;
      best_ = refined({.consensus = consensus_on(*found), .cost = cost});
      samples = std::min(limits_.max_samples, samples_needed());
    }
    if (best_.consensus.agrees.empty()) return std::nullopt;
    return best_.consensus;
  }

 private:
  /// Different pairs; std::uniform_int_distribution would differ between standard libraries.
  void draw() {
    sample_.clear();
    chosen_.clear();
    while (sample_.size() < model_.sample) {
      const std::size_t index = generator_() % pairs_.size();
      if (std::find(chosen_.begin(), chosen_.end(), index) != chosen_.end()) continue;
      chosen_.push_back(index);
      sample_.push_back(pairs_[index]);
    }
  }

  /// Sum of the squared distances, cut off at the limit; stops early once it reaches `enough`.
  [[nodiscard]] double cost_below(double enough, const Eigen::Matrix3d& relation) const {
    double cost = 0.0;
    for (const PixelPair& pair : pairs_) {
      const double distance = model_.distance(relation, pair);
      const double counted =
          distance <= limits_.max_distance_px ? distance : limits_.max_distance_px;
      cost += counted * counted;
      if (cost >= enough) break;
    }
    return cost;
  }

  [[nodiscard]] Consensus consensus_on(const Eigen::Matrix3d& relation) const {
    Consensus consensus{.model = relation, .agrees = {}};
    consensus.agrees.reserve(pairs_.size());
    for (const PixelPair& pair : pairs_) {
      const bool agrees = model_.distance(relation, pair) <= limits_.max_distance_px;
      consensus.agrees.push_back(agrees);
      consensus.count += agrees ? 1 : 0;
    }
    return consensus;
  }

  /// Fitted to all pairs that agree with it, for as long as that explains more.
  [[nodiscard]] Scored refined(Scored scored) const {
    std::vector<PixelPair> agreeing;
    for (int i = 0; i < kMaxRefits; ++i) {
      agreeing.clear();
      for (std::size_t k = 0; k < pairs_.size(); ++k) {
        if (scored.consensus.agrees[k]) agreeing.push_back(pairs_[k]);
      }
      if (agreeing.size() < model_.sample) break;
      const auto refit = model_.fit(agreeing);
      if (!refit) break;
      const double cost = cost_below(scored.cost, *refit);
      if (cost >= scored.cost) break;
      scored = {.consensus = consensus_on(*refit), .cost = cost};
    }
    return scored;
  }

  /// Until one of them holds no wrong pair, with the confidence asked for.
  [[nodiscard]] int samples_needed() const {
    const double share =
        static_cast<double>(best_.consensus.count) / static_cast<double>(pairs_.size());
    const double p_good = std::pow(share, static_cast<double>(model_.sample));
    if (p_good >= limits_.confidence) return 1;
    const double needed = std::log1p(-limits_.confidence) / std::log1p(-p_good);
    return static_cast<int>(std::min(std::ceil(needed), 1e9));
  }

  const PairModel& model_;
  std::span<const PixelPair> pairs_;
  const ConsensusLimits& limits_;
  std::mt19937 generator_;
  std::vector<std::size_t> chosen_;
  std::vector<PixelPair> sample_;
  Scored best_;
};

}  // namespace

std::optional<Consensus> find_consensus(const PairModel& model,
                                        std::span<const PixelPair> pairs,
                                        const ConsensusLimits& limits) {
  if (pairs.size() < model.sample) return std::nullopt;
  return ConsensusSearch(model, pairs, limits).run();
}

}  // namespace tsg
