#pragma once

#include <atomic>
#include <functional>
#include <future>
#include <memory>
#include <optional>
#include <thread>
#include <vector>

#include "common/core/bounded_queue.hpp"
#include "common/core/shared_value.hpp"
#include "services/slam/lib/local_mapper.hpp"
#include "services/slam/lib/map_contents.hpp"

namespace tsg {

enum class MappingMode {
  kConcurrent,   ///< in a thread of its own, beside tracking
  kSynchronous,  ///< in the caller's thread, done when the call returns: reproducible
};

/// Owns the map and the thread that works on it. All calls come from the tracking thread.
class MappingLoop {
 public:
  MappingLoop(LocalMapper mapper, MappingMode mode);

  /// The newest local map; never null.
  [[nodiscard]] std::shared_ptr<const LocalMapSnapshot> snapshot() const {
    return snapshot_.load();
  }

  /// Every keyframe's pose after the latest correction of the whole map; null before the first.
  [[nodiscard]] std::shared_ptr<const std::vector<KeyframePose>> corrected_poses() const {
    return corrected_poses_.load();
  }

  void insert(KeyframeCandidate&& candidate);
  /// Asks for the part of the map that shows the view of a lost frame; a snapshot to come is it.
  /// Does nothing while an earlier call is not answered.
  void recall(const std::shared_ptr<const Features>& view);
  /// The local map shall lie around this keyframe, for a map that does not grow with the camera.
  /// Does nothing where it does already.
  void centre_on(KeyframeId reference);
  void remove_points(std::vector<PointId> points);
  /// Copies the mask.
  void apply_mask(const InstanceSegmentation& mask);

  /// Every keyframe's pose once all that was asked before is done.
  [[nodiscard]] std::vector<KeyframePose> keyframe_poses();

  /// A copy of the map once all that was asked before is done.
  [[nodiscard]] std::future<MapContents> contents();

 private:
  using Task = std::function<void(LocalMapper&, const std::stop_token&)>;

  void post(Task task);
  void carry_out(const Task& task, const std::stop_token& stop);
  void work(const std::stop_token& stop);
  void publish();

  LocalMapper mapper_;  // owned by worker_ while there is one
  SharedValue<LocalMapSnapshot> snapshot_;
  SharedValue<std::vector<KeyframePose>> corrected_poses_;
  std::atomic<bool> is_recalling_ = false;
  std::optional<KeyframeId> centre_;  // asked for last; of the tracking thread
  // Nothing may be lost: a map without its keyframe would no longer fit what tracking refers to.
  BoundedQueue<Task> tasks_{kMaxTasks, WhenFull::kBlock};
  std::jthread worker_;

  static constexpr std::size_t kMaxTasks = 64;  // several seconds of keyframes
};

}  // namespace tsg
