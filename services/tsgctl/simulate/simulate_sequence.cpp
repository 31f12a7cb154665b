#include "services/tsgctl/simulate/simulate_sequence.hpp"

#include <stop_token>
#include <thread>
#include <utility>
#include <vector>

#include "common/core/bounded_queue.hpp"
#include "services/tsgctl/simulate/sequence_writer.hpp"

namespace tsg {
namespace {

using simulation::SimulatedFrame;

constexpr std::size_t kFramesWaiting = 4;  // enough that neither side waits for a slow frame

/// Writes frames on a thread of its own, up to the first that fails.
class WritingThread {
 public:
  explicit WritingThread(SequenceWriter writer)
      : writer_(std::move(writer)),
        queue_(kFramesWaiting, WhenFull::kBlock),
        thread_([this](const std::stop_token& stop) { run(stop); }) {}

  /// False once a frame could not be written.
  bool add(SimulatedFrame frame) { return queue_.push(std::move(frame), failed_.get_token()); }

  /// Waits for the last frame and writes the lists.
  [[nodiscard]] Expected<void> finish() {
    thread_.request_stop();  // what waits is still written
    thread_.join();
    return result_.and_then([this] { return writer_.finish(); });
  }

 private:
  void run(const std::stop_token& stop) {
    while (const auto frame = queue_.pop(stop)) {
      result_ = writer_.add(*frame);
      if (result_) continue;
      failed_.request_stop();
      return;
    }
  }

  SequenceWriter writer_;    // of the thread until it is joined
  Expected<void> result_{};  // the same
  std::stop_source failed_;
  BoundedQueue<SimulatedFrame> queue_;
  std::jthread thread_;  // last: ends before what it uses
};

}  // namespace

Expected<void> simulate_sequence(simulation::Simulator& simulator,
                                 int frames,
                                 const std::filesystem::path& folder,
                                 const std::function<void(int)>& on_frame) {
  auto writer = SequenceWriter::open(folder, simulator.scene().sensor, simulator.instances());
  if (!writer) return tl::unexpected(writer.error());
  WritingThread writing(std::move(*writer));
  std::vector<int> rendered;
  for (int frame = 0; frame < frames; ++frame) {
    if (!writing.add(simulator.render(frame))) break;
    rendered.push_back(frame);
    on_frame(frame + 1);
  }
  if (auto truth = write_truth_of_scene(simulator, rendered, folder); !truth) return truth;
  return writing.finish();  // last, as a folder without lists is one that was not finished
}

}  // namespace tsg
