#include "services/tsgctl/dynamic/verdict_score.hpp"

#include <algorithm>

#include "common/core/statistics.hpp"

namespace tsg {
namespace {

std::optional<double> share(std::uint64_t part, std::uint64_t whole) {
  if (whole == 0) return std::nullopt;
  return static_cast<double>(part) / static_cast<double>(whole);
}

bool are_most(std::uint64_t part, std::uint64_t whole) {
  return static_cast<double>(part) >= kMostFeatures * static_cast<double>(whole);
}

FeatureKind kind_of(const TrueInstance& instance) {
  const bool is_moving = instance.state == TrueState::kMoving;
  switch (instance.prior) {
    case FeatureVerdict::kDynamic:
      return FeatureKind::kDynamicClasses;
    case FeatureVerdict::kPotentiallyDynamic:
      return is_moving ? FeatureKind::kPotentiallyMoving : FeatureKind::kPotentiallyStill;
    case FeatureVerdict::kStatic:
      break;
  }
  return is_moving ? FeatureKind::kUnexpectedlyMoving : FeatureKind::kStaticThings;
}

/// People are to be removed whatever they do, and static things that stay are no question.
bool is_of_interest(const TrueInstance& instance) {
  if (instance.state == TrueState::kUnknown) return false;
  const FeatureKind kind = kind_of(instance);
  return kind != FeatureKind::kStaticThings && kind != FeatureKind::kDynamicClasses;
}

void count(bool is_removed, Judged& judged) { ++(is_removed ? judged.removed : judged.kept); }

/// Median and least of the shares that frames have of their own.
FrameSpread spread_of(std::vector<double> shares) {
  if (shares.empty()) return {};
  std::sort(shares.begin(), shares.end());
  return {.frames = shares.size(), .median = quantile(shares, 0.5), .worst = shares.front()};
}

void add_to(InstanceTally& tally, const InstanceScore& score) {
  const Judged& features = score.features;
  if (features.total() < kMinFeatures) return;
  if (score.is_moving) {
    ++tally.frames_moving;
    if (are_most(features.removed, features.total())) ++tally.frames_removed;
  } else {
    ++tally.frames_still;
    if (are_most(features.kept, features.total())) ++tally.frames_kept;
  }
}

}  // namespace

Judged& Judged::operator+=(const Judged& other) {
  removed += other.removed;
  kept += other.kept;
  return *this;
}

VerdictCounts& VerdictCounts::operator+=(const VerdictCounts& other) {
  for (std::size_t i = 0; i < by_state.size(); ++i) by_state[i] += other.by_state[i];
  return *this;
}

std::optional<double> VerdictCounts::recall() const {
  const Judged& moving = of(TrueState::kMoving);
  return share(moving.removed, moving.total());
}

std::optional<double> VerdictCounts::precision() const {
  const std::uint64_t rightly = of(TrueState::kMoving).removed;
  return share(rightly, rightly + of(TrueState::kStill).removed);
}

VerdictCounts FrameScore::away_from_edges() const {
  VerdictCounts sum;
  for (const auto& [name, counts] : by_class) sum += counts;
  return sum;
}

std::optional<double> InstanceTally::removed_share() const {
  return share(frames_removed, frames_moving);
}

std::optional<double> InstanceTally::kept_share() const { return share(frames_kept, frames_still); }

VerdictCounts VerdictSummary::with_edges() const {
  VerdictCounts sum = total;
  sum += at_edge;
  return sum;
}

FrameScore score_frame(const FrameVerdicts& verdicts, const FrameTruth& truth) {
  FrameScore score;
  std::vector<Judged> by_instance(truth.instances.size());
  for (const JudgedFeature& feature : verdicts.features) {
    const std::size_t label = truth.labels.at<std::uint8_t>(feature.raw_y, feature.raw_x);
    const TrueInstance* instance = label == 0 ? nullptr : &truth.instances.at(label - 1);
    const TrueState state = instance == nullptr ? TrueState::kStill : instance->state;
    if (state != TrueState::kUnknown) {
      const auto kind = instance == nullptr ? FeatureKind::kStaticThings : kind_of(*instance);
      count(feature.is_dynamic, score.kinds[static_cast<std::size_t>(kind)]);
    }
    if (truth.at_edge.at<std::uint8_t>(feature.raw_y, feature.raw_x) != 0) {
      count(feature.is_dynamic, score.at_edge.of(state));
      continue;
    }
    const std::string name = instance == nullptr ? kBackground : instance->class_name;
    count(feature.is_dynamic, score.by_class[name].of(state));
    if (instance != nullptr) count(feature.is_dynamic, by_instance[label - 1]);
  }
  for (std::size_t i = 0; i < truth.instances.size(); ++i) {
    const TrueInstance& instance = truth.instances[i];
    if (!is_of_interest(instance) || by_instance[i].total() == 0) continue;
    score.instances.push_back({.id = instance.id,
                               .class_name = instance.class_name,
                               .name = instance.name,
                               .is_moving = instance.state == TrueState::kMoving,
                               .features = by_instance[i]});
  }
  return score;
}

VerdictSummary summarise(const std::vector<FrameScore>& scores) {
  VerdictSummary summary{.frames = scores.size()};
  std::vector<double> recalls;
  std::vector<double> precisions;
  std::map<int, InstanceTally> tallies;
  for (const FrameScore& score : scores) {
    const VerdictCounts counts = score.away_from_edges();
    const Judged& moving = counts.of(TrueState::kMoving);
    if (moving.total() >= kMinFeatures) recalls.push_back(*counts.recall());
    const std::uint64_t removed = moving.removed + counts.of(TrueState::kStill).removed;
    if (removed >= kMinFeatures) precisions.push_back(*counts.precision());
    summary.total += counts;
    summary.at_edge += score.at_edge;
    for (const auto& [name, of_class] : score.by_class) summary.by_class[name] += of_class;
    for (std::size_t i = 0; i < kFeatureKinds; ++i) summary.kinds[i] += score.kinds[i];
    for (const InstanceScore& instance : score.instances) {
      InstanceTally& tally = tallies[instance.id];
      tally.id = instance.id;
      tally.class_name = instance.class_name;
      tally.name = instance.name;
      add_to(tally, instance);
    }
  }
  summary.recall = spread_of(std::move(recalls));
  summary.precision = spread_of(std::move(precisions));
  for (const auto& [id, tally] : tallies) {
    if (tally.frames_moving + tally.frames_still > 0) summary.instances.push_back(tally);
  }
  return summary;
}

}  // namespace tsg
