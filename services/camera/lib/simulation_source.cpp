#include "services/camera/lib/simulation_source.hpp"

#include <opencv2/core/mat.hpp>
#include <utility>

namespace tsg {
namespace {

using simulation::Simulator;

class FrameToRender : public PendingFrame {
 public:
  FrameToRender(std::shared_ptr<Simulator> simulator, int index, std::int64_t stamp_ns)
      : simulator_(std::move(simulator)), index_(index), stamp_ns_(stamp_ns) {}

  [[nodiscard]] std::int64_t stamp_ns() const override { return stamp_ns_; }
  [[nodiscard]] Expected<void> decode(const cv::Mat& colour, const cv::Mat& depth) const override {
    const simulation::SimulatedFrame frame = simulator_->render(index_);
    frame.colour.copyTo(colour);
    frame.depth.copyTo(depth);
    return {};
  }

 private:
  // Frames are decoded one after the other, so that one thread renders at a time.
  std::shared_ptr<Simulator> simulator_;
  int index_;
  std::int64_t stamp_ns_;
};

}  // namespace

SimulationSource::SimulationSource(Simulator simulator, std::int64_t start_ns, SceneEnd end)
    : simulator_(std::make_shared<Simulator>(std::move(simulator))),
      start_ns_(start_ns),
      end_(end),
      info_{simulator_->scene().sensor.camera, simulation::kDepthUnitsPerMetre,
            simulator_->scene().sensor.rate_hz} {}

Expected<std::unique_ptr<PendingFrame>> SimulationSource::next() {
  // Of the simulator only what never changes is read here: frames may be rendered meanwhile.
  if (end_ == SceneEnd::kStop && next_ >= simulator_->frame_count()) return nullptr;
  const int index = next_++;
  return std::make_unique<FrameToRender>(simulator_, index,
                                         start_ns_ + simulator_->since_start_ns(index));
}

}  // namespace tsg
