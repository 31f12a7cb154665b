#include "services/segmentation/lib/dataset_provider.hpp"

#include <cstdint>
#include <utility>

#include "common/core/time.hpp"
#include "common/dataset/image_file.hpp"

namespace tsg {

namespace {

// Masks carry the stamps of the frames that they belong to; lists may round these.
constexpr std::int64_t kMaxStampDifferenceNs = 1'000'000;

}  // namespace

Expected<std::unique_ptr<SegmentationProvider>> DatasetProvider::make(
    const std::filesystem::path& folder) {
  auto truth = InstanceTruth::open(folder);
  if (!truth) return tl::unexpected(truth.error());
  return std::unique_ptr<SegmentationProvider>(new DatasetProvider(std::move(*truth)));
}

Expected<SegmentationResult> DatasetProvider::segment(const RgbdFrame& frame, cv::Mat& labels) {
  if (is_cancelled_) return make_error(ExitCode::kFailure, "cancelled");
  SegmentationResult result;
  Stopwatch watch;
  auto truth = truth_.at(frame.stamp_ns, kMaxStampDifferenceNs);
  if (!truth) return tl::unexpected(truth.error());
  result.times.preprocess_ns = watch.lap_ns();
  if (truth->labels.size() != frame.colour.size()) {
    return make_error(ExitCode::kSizeMismatch,
                      "the recorded mask is " + text_of(truth->labels.size()) + ", the frame " +
                          text_of(frame.colour.size()) +
                          "; give the folder of the sequence that is replayed");
  }
  truth->frame_seq = frame.seq;
  truth->stamp_ns = frame.stamp_ns;
  for (Instance& instance : truth->instances) instance.motion = MotionVerdict::kUnknown;
  truth->labels.copyTo(labels);
  truth->labels = labels;
  result.segmentation = std::move(*truth);
  result.times.postprocess_ns = watch.lap_ns();
  return result;
}

}  // namespace tsg
