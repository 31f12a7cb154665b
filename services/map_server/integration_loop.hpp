#pragma once

#include <chrono>
#include <functional>
#include <future>
#include <memory>
#include <optional>
#include <stop_token>
#include <thread>
#include <type_traits>
#include <utility>
#include <variant>

#include "common/app/log.hpp"
#include "common/core/bounded_queue.hpp"
#include "services/map_server/config.hpp"
#include "services/map_server/progress.hpp"

namespace tsg {

/// The thread that owns the map: integrates keyframes and answers questions about the map, in the
/// order in which they were given.
class IntegrationLoop {
 public:
  /// Keyframes that still wait at the end are integrated for this long, then discarded.
  static constexpr std::chrono::milliseconds kDrainTime{1000};

  IntegrationLoop(const MapServerConfig& config, Progress& progress, Log log);

  /// Hands a keyframe over; it must own its pixels. Waits while the queue is full; false where
  /// `stop` came first.
  bool submit(MapKeyframe keyframe, const std::stop_token& stop);

  /// Asks the map: `question` runs on the loop's thread, after the keyframes submitted before, and
  /// is answered even while the loop drains. Nothing where `stop` came before there was room.
  template <typename Question, typename Answer = std::invoke_result_t<Question, const SemanticMap&>>
  std::optional<std::future<Answer>> ask(Question question, const std::stop_token& stop) {
    auto promise = std::make_shared<std::promise<Answer>>();
    std::future<Answer> answer = promise->get_future();
    MapQuestion job = [promise, question = std::move(question)](const SemanticMap& map) {
      promise->set_value(question(map));
    };
    if (!jobs_.push(Job(std::move(job)), stop)) return std::nullopt;
    return answer;
  }

  /// Keyframes and questions that wait.
  [[nodiscard]] std::size_t backlog() const { return jobs_.size(); }

  /// Ends the thread within kDrainTime and the time for one keyframe. Nothing may be submitted
  /// after.
  void stop_and_join();

 private:
  using MapQuestion = std::function<void(const SemanticMap&)>;
  using Job = std::variant<MapKeyframe, MapQuestion>;

  void run(const std::stop_token& stop);
  void integrate(const MapKeyframe& keyframe);

  Progress& progress_;
  Log log_;
  SemanticMap map_;  // of the thread
  BoundedQueue<Job> jobs_;
  std::jthread thread_;  // last: it uses all of the above
};

}  // namespace tsg
