#include "services/segmentation/lib/model_provider.hpp"

#include <filesystem>
#include <utility>

#include "common/core/time.hpp"
#include "services/segmentation/lib/decoders/class_names.hpp"
#include "services/segmentation/lib/make_decoder.hpp"

namespace tsg {

namespace {

Expected<std::unique_ptr<InstanceDecoder>> decoder_for(const ModelProviderConfig& config,
                                                       const ModelDescription& model) {
  if (config.labels_file.empty()) return make_decoder(model, config.decoder, std::nullopt);
  auto names = read_labels_file(config.labels_file);
  if (!names) return tl::unexpected(names.error());
  return make_decoder(model, config.decoder, std::move(*names));
}

}  // namespace

ModelProvider::ModelProvider(const ModelFile& file,
                             OnnxModel model,
                             std::unique_ptr<InstanceDecoder> decoder)
    : name_(file.path().filename()),
      file_(file),
      model_(std::move(model)),
      decoder_(std::move(decoder)) {}

Expected<std::unique_ptr<ModelProvider>> ModelProvider::make(const ModelProviderConfig& config) {
  const auto of_this_file = [&](const Error& error) {
    return make_error(error.code, "the model " + config.model.file + ": " + error.message);
  };
  const ModelFile file(config.model.file);  // before it is read: what comes later is newer
  auto model = OnnxModel::load(config.model);
  if (!model) return tl::unexpected(model.error());
  auto decoder = decoder_for(config, model->description());
  if (!decoder) return of_this_file(decoder.error());
  if (auto allocated = model->allocate(); !allocated) return of_this_file(allocated.error());
  return std::unique_ptr<ModelProvider>(
      new ModelProvider(file, std::move(*model), std::move(*decoder)));
}

Expected<SegmentationResult> ModelProvider::segment(const RgbdFrame& frame, cv::Mat& labels) {
  SegmentationResult result;
  Stopwatch watch;
  if (!writer_ || writer_->letterbox().frame_size != frame.colour.size()) {
    writer_.emplace(frame.colour.size(), decoder_->input_format());
  }
  writer_->write(frame.colour, model_.input(0));
  result.times.preprocess_ns = watch.lap_ns();

  if (auto ran = model_.run(); !ran) return tl::unexpected(ran.error());
  result.times.network_ns = watch.lap_ns();

  auto decoded = decoder_->decode(model_.outputs(), writer_->letterbox(), labels);
  if (!decoded) return tl::unexpected(decoded.error());
  result.left_out = decoded->left_out;
  result.segmentation = {.frame_seq = frame.seq,
                         .stamp_ns = frame.stamp_ns,
                         .labels = labels,
                         .instances = std::move(decoded->instances)};
  tracker_.follow(result.segmentation);
  result.times.postprocess_ns = watch.lap_ns();
  return result;
}

ProviderState ModelProvider::state() {
  const ExecutionProvider& runs_on = model_.execution_provider();
  ProviderState state{.problem = runs_on.why_not_wanted, .values = {{"runs_on", runs_on.name}}};
  if (const std::string changed = file_.change(); !changed.empty()) {
    state.problem += (state.problem.empty() ? "" : "; ") + changed;
  }
  return state;
}

}  // namespace tsg
