#include "services/segmentation/lib/yolo_seg_provider.hpp"

#include <filesystem>
#include <utility>

#include "common/core/time.hpp"

namespace tsg {

YoloSegProvider::YoloSegProvider(const YoloSegProviderConfig& config,
                                 OnnxModel model,
                                 YoloSegLayout layout)
    : config_(config.decoder),
      name_(std::filesystem::path(config.model.file).filename()),
      model_(std::move(model)),
      layout_(std::move(layout)) {}

Expected<std::unique_ptr<SegmentationProvider>> YoloSegProvider::make(
    const YoloSegProviderConfig& config) {
  auto model = OnnxModel::load(config.model);
  if (!model) return tl::unexpected(model.error());
  auto layout = yolo_seg_layout(model->description());
  if (!layout) {
    return make_error(layout.error().code,
                      "the model " + config.model.file + ": " + layout.error().message);
  }
  if (auto allocated = model->allocate(); !allocated) return tl::unexpected(allocated.error());
  return std::unique_ptr<SegmentationProvider>(
      new YoloSegProvider(config, std::move(*model), std::move(*layout)));
}

Expected<SegmentationResult> YoloSegProvider::segment(const RgbdFrame& frame) {
  SegmentationResult result;
  Stopwatch watch;
  if (!writer_ || writer_->letterbox().frame_size != frame.colour.size()) {
    writer_.emplace(make_letterbox(frame.colour.size(), layout_.input_size));
  }
  writer_->write(frame.colour, model_.input(0));
  result.times.preprocess_ns = watch.lap_ns();

  if (auto ran = model_.run(); !ran) return tl::unexpected(ran.error());
  result.times.network_ns = watch.lap_ns();

  const YoloSegTensors tensors{.anchors = model_.output(0), .prototypes = model_.output(1)};
  const MaskContext context{layout_, tensors, writer_->letterbox()};
  auto decoded = decode_yolo_seg(context, config_, labels_);
  if (!decoded) return tl::unexpected(decoded.error());
  result.left_out = decoded->left_out;
  result.segmentation = {.frame_seq = frame.seq,
                         .stamp_ns = frame.stamp_ns,
                         .labels = labels_,
                         .instances = std::move(decoded->instances)};
  result.times.postprocess_ns = watch.lap_ns();
  return result;
}

}  // namespace tsg
