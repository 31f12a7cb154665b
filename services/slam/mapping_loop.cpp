#include "services/slam/mapping_loop.hpp"

#include <utility>

namespace tsg {

MappingLoop::MappingLoop(LocalMapper mapper, MappingMode mode)
    : mapper_(std::move(mapper)), snapshot_(mapper_.snapshot()) {
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

void MappingLoop::recall(const std::shared_ptr<const Features>& view) {
  centre_.reset();  // the snapshot to come lies elsewhere
  if (is_recalling_.exchange(true)) return;
  post([this, view](LocalMapper& mapper, const std::stop_token&) {
    mapper.recall(*view);
    is_recalling_ = false;
  });
}

void MappingLoop::centre_on(KeyframeId reference) {
  if (centre_ == reference) return;
  centre_ = reference;
  post([reference](LocalMapper& mapper, const std::stop_token&) { mapper.centre_on(reference); });
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

std::future<MapContents> MappingLoop::contents() {
  auto contents = std::make_shared<std::promise<MapContents>>();
  auto result = contents->get_future();
  post([contents](LocalMapper& mapper, const std::stop_token&) {
    contents->set_value(mapper.contents());
  });
  return result;
}

void MappingLoop::post(Task task) {
  if (worker_.joinable()) {
    tasks_.push(std::move(task));
  } else {
    carry_out(task, {});
    while (mapper_.is_adjusting()) mapper_.adjust({});
    publish();
  }
}

void MappingLoop::carry_out(const Task& task, const std::stop_token& stop) {
  task(mapper_, stop);
  publish();
}

void MappingLoop::publish() {
  auto snapshot = mapper_.snapshot();
  if (snapshot->corrections != snapshot_.load()->corrections) {
    corrected_poses_.store(
        std::make_shared<const std::vector<KeyframePose>>(mapper_.keyframe_poses()));
  }
  snapshot_.store(std::move(snapshot));
}

void MappingLoop::work(const std::stop_token& stop) {
  const auto must_pause = [&] { return stop.stop_requested() || tasks_.size() > 0; };
  while (true) {
    const bool is_adjusting = mapper_.is_adjusting();
    // After a stop the rest is still done; refine() then returns at once.
    const auto task = is_adjusting ? tasks_.try_pop() : tasks_.pop(stop);
    if (task) {
      carry_out(*task, stop);
    } else if (stop.stop_requested()) {
      return;
    } else {
      mapper_.adjust(must_pause);
      publish();
    }
  }
}

}  // namespace tsg
