#include "services/slam/lib/loop_closer.hpp"

#include <utility>

#include "services/slam/lib/part_merging.hpp"

namespace tsg {
namespace {

constexpr int kMinMatchesToRecall = 10;  // relocalisation asks for more

}  // namespace

LoopCloser::LoopCloser(const ObservationModel& model, const SlamConfig& config)
    : model_(model),
      config_(config),
      index_(static_cast<std::size_t>(config.loop.max_keyframes)),
      detector_(model, config) {}

void LoopCloser::add(const Keyframe& keyframe) { index_.add(keyframe.id, keyframe.features); }

void LoopCloser::remove(KeyframeId id, KeyframeId parent, const SE3& T_parent_camera) {
  index_.remove(id);
  for (LoopEdge& loop : loops_) {
    if (loop.a == id) loop = {parent, loop.b, T_parent_camera * loop.T_a_b};
    if (loop.b == id) loop = {loop.a, parent, loop.T_a_b * T_parent_camera.inverse()};
  }
  std::erase_if(loops_, [](const LoopEdge& loop) { return loop.a == loop.b; });
}

void LoopCloser::take_over(const Map& map, std::vector<LoopEdge> loops, bool is_adjusting) {
  for (const auto& [id, keyframe] : map.keyframes()) add(keyframe);
  loops_ = std::move(loops);
  if (is_adjusting) adjustment_.emplace(map, model_, map.keyframes().rbegin()->second.part);
}

bool LoopCloser::close(Map& map,
                       KeyframeId newest,
                       MapPart main_part,
                       const std::function<bool()>& must_stop) {
  if (!config_.loop.enabled) return false;
  const auto loop = detector_.detect(map, index_, newest);
  if (!loop) return false;
  const bool joins_parts = map.keyframe(newest).part != map.keyframe(loop->seen_before).part;
  merge_parts_of(map, model_, *loop, main_part);
  loops_.push_back({loop->seen_before, loop->newest, loop->T_before_newest});
  const MapPart part = map.keyframe(newest).part;
  // Parts that were just joined fit each other already; the loops within them are one more reason.
  if (!correct_map(map, model_, loops_, part, must_stop) && !joins_parts) {
    loops_.pop_back();
    return false;
  }
  join_sides(map, model_, config_.mapper, loop->seen_before, loop->newest);
  detector_.reset();
  adjustment_.emplace(map, model_, part);
  return true;
}

bool LoopCloser::adjust(Map& map, const std::function<bool()>& must_stop) {
  if (!adjustment_) return false;
  adjustment_->advance(model_, must_stop);
  if (!adjustment_->is_done()) return false;
  adjustment_->write_back(map, model_);
  adjustment_.reset();
  detector_.reset();
  return true;
}

std::vector<PlaceCandidate> LoopCloser::recall(const Features& features) const {
  return index_.query(features, {}, kMinMatchesToRecall);
}

}  // namespace tsg
