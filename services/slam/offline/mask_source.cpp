#include "services/slam/offline/mask_source.hpp"

#include <utility>

namespace tsg {

Expected<MaskSource> MaskSource::open(const std::filesystem::path& folder,
                                      const MaskOptions& options) {
  MaskSource source(options);
  if (!options.use || !std::filesystem::exists(folder / "instances.json")) return source;
  auto truth = InstanceTruth::open(folder);
  if (!truth) return tl::unexpected(truth.error());
  source.truth_ = std::move(*truth);
  return source;
}

Expected<const InstanceSegmentation*> MaskSource::latest(const RgbdFrame& frame,
                                                         std::int64_t recorded_ns) {
  if (!truth_) return nullptr;
  if (frame.seq % static_cast<std::uint64_t>(options_.every_frames) == 0) {
    auto mask = truth_->at(recorded_ns);
    if (!mask) return tl::unexpected(mask.error());
    mask->frame_seq = frame.seq;
    mask->stamp_ns = frame.stamp_ns;
    pending_.push_back(std::move(*mask));
  }
  const auto delay = static_cast<std::uint64_t>(options_.delay_frames);
  while (!pending_.empty() && pending_.front().frame_seq + delay <= frame.seq) {
    latest_ = std::move(pending_.front());
    pending_.pop_front();
  }
  return latest_ ? &*latest_ : nullptr;
}

}  // namespace tsg
