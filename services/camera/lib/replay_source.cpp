#include "services/camera/lib/replay_source.hpp"

#include <cmath>
#include <utility>

namespace tsg {
namespace {

class RecordedFrame : public PendingFrame {
 public:
  RecordedFrame(RgbdFiles files, std::int64_t stamp_ns)
      : files_(std::move(files)), stamp_ns_(stamp_ns) {}

  [[nodiscard]] std::int64_t stamp_ns() const override { return stamp_ns_; }
  [[nodiscard]] Expected<void> decode(const cv::Mat& colour, const cv::Mat& depth) const override {
    return decode_frame(files_, colour, depth);
  }

 private:
  RgbdFiles files_;
  std::int64_t stamp_ns_;
};

}  // namespace

Expected<std::unique_ptr<ReplaySource>> ReplaySource::open(const ReplayConfig& config) {
  if (config.folder.empty()) {
    return make_error(ExitCode::kConfig,
                      "camera.replay.folder is not set; set it to a sequence in TUM layout");
  }
  auto folder = open_tum_folder(config.folder);
  if (!folder) return tl::unexpected(folder.error());
  return std::unique_ptr<ReplaySource>(new ReplaySource(std::move(*folder), config.loop));
}

ReplaySource::ReplaySource(TumFolder folder, bool loop)
    : folder_(std::move(folder)),
      loop_(loop),
      info_{folder_.camera.model, folder_.camera.depth_units_per_metre, folder_.camera.fps} {}

Expected<std::unique_ptr<PendingFrame>> ReplaySource::next() {
  const std::vector<RgbdFiles>& frames = folder_.frames;
  if (next_ == frames.size()) {
    if (!loop_) return nullptr;
    const auto period_ns = static_cast<std::int64_t>(std::llround(1e9 / info_.fps));
    shift_ns_ += frames.back().stamp_ns - frames.front().stamp_ns + period_ns;
    next_ = 0;
  }
  const RgbdFiles& files = frames[next_++];
  return std::make_unique<RecordedFrame>(files, files.stamp_ns + shift_ns_);
}

}  // namespace tsg
