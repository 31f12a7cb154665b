#include "services/slam/mapping_loop.hpp"

#include <future>
#include <utility>

namespace tsg {

MappingLoop::MappingLoop(const SlamConfig& config, const CameraModel& camera, MappingMode mode)
    : mapper_(config, camera), snapshot_(mapper_.snapshot()) {
  if (mode == MappingMode::kConcurrent) {
    worker_ = std::jthread([this](const std::stop_token& stop) { work(stop); });
  }
}

void MappingLoop::insert(KeyframeCandidate&& candidate) {
  // Shared, as a std::function must be copyable.
  auto shared = std::make_shared<KeyframeCandidate>(std::move(candidate));
  post([this, shared](LocalMapper& mapper, const std::stop_token& stop) {
    mapper.insert(std::move(*shared));
    snapshot_.store(mapper.snapshot());  // tracking may use the new points while they are refined
    mapper.refine(stop);
  });
}

void MappingLoop::remove_points(std::vector<PointId> points) {
  if (points.empty()) return;
  post([points = std::move(points)](LocalMapper& mapper, const std::stop_token&) {
    mapper.remove_points(points);
  });
}

void MappingLoop::apply_mask(const InstanceSegmentation& mask) {
  InstanceSegmentation copy = mask;
  copy.labels = mask.labels.clone();
  post([copy = std::move(copy)](LocalMapper& mapper, const std::stop_token&) {
    mapper.apply_mask(copy);
  });
}

std::vector<KeyframePose> MappingLoop::keyframe_poses() {
  auto poses = std::make_shared<std::promise<std::vector<KeyframePose>>>();
  auto result = poses->get_future();
  post([poses](LocalMapper& mapper, const std::stop_token&) {
    poses->set_value(mapper.keyframe_poses());
  });
  return result.get();
}

void MappingLoop::post(Task task) {
  if (worker_.joinable()) {
    tasks_.push(std::move(task));
  } else {
    carry_out(task, {});
  }
}

void MappingLoop::carry_out(const Task& task, const std::stop_token& stop) {
  task(mapper_, stop);
  snapshot_.store(mapper_.snapshot());
}

void MappingLoop::work(const std::stop_token& stop) {
  // After a stop the rest is still done; refine() then returns at once.
  while (const auto task = tasks_.pop(stop)) carry_out(*task, stop);
}

}  // namespace tsg
