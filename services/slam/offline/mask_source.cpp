#include "services/slam/offline/mask_source.hpp"

#include <utility>

namespace tsg {

Expected<MaskSource> MaskSource::open(const std::filesystem::path& folder,
                                      const MaskOptions& options) {
  MaskSource source(options.faults);
  if (!options.use || !std::filesystem::exists(folder / "instances.json")) return source;
  auto truth = InstanceTruth::open(folder);
  if (!truth) return tl::unexpected(truth.error());
  source.truth_ = std::move(*truth);
  return source;
}

Expected<const InstanceSegmentation*> MaskSource::latest(const RgbdFrame& frame,
                                                         std::int64_t recorded_ns) {
  if (!truth_) return nullptr;
  if (faults_.is_segmented(frame.seq)) {
    auto mask = truth_->at(recorded_ns);
    if (!mask) return tl::unexpected(mask.error());
    mask->frame_seq = frame.seq;
    mask->stamp_ns = frame.stamp_ns;
    if (auto seen = faults_.apply(std::move(*mask))) delayed_.put(frame.seq, std::move(*seen));
  }
  while (auto due = delayed_.take_due(frame.seq)) latest_ = std::move(due);
  return latest_ ? &*latest_ : nullptr;
}

}  // namespace tsg
