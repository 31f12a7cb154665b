#include "services/segmentation/lib/make_decoder.hpp"

#include <algorithm>
#include <functional>
#include <utility>

#include "services/segmentation/lib/decoders/input_image.hpp"
#include "services/segmentation/lib/decoders/rtmdet_decoder.hpp"
#include "services/segmentation/lib/decoders/solov2_decoder.hpp"
#include "services/segmentation/lib/decoders/yolo_seg_decoder.hpp"

namespace tsg {

namespace {

using MadeDecoder = Expected<std::unique_ptr<InstanceDecoder>>;
using Make = std::function<MadeDecoder(
    const ModelDescription& model, const ClassNames& names, const DecoderConfig& config)>;

/// Reads the layout, which may say what differs, and makes its decoder.
template <typename Decoder, typename Layout>
Make with(Expected<Layout> (*read)(const ModelDescription&, const ClassNames&)) {
  return [read](const ModelDescription& model, const ClassNames& names,
                const DecoderConfig& config) -> MadeDecoder {
    auto layout = read(model, names);
    if (!layout) return tl::unexpected(layout.error());
    return std::make_unique<Decoder>(std::move(*layout), config);
  };
}

/// Which layout the outputs come nearest to, by their number and types; none for all others.
Make nearest_layout(const ModelDescription& model) {
  const bool has_integers =
      std::any_of(model.outputs.begin(), model.outputs.end(),
                  [](const auto& output) { return output.type == ElementType::kInt64; });
  const std::size_t count = model.outputs.size();
  if (count == 2 && !has_integers) return with<YoloSegDecoder>(yolo_seg_layout);
  if (count == 3 && has_integers) return with<RtmdetDecoder>(rtmdet_layout);
  if ((count == 3 || count == 11) && !has_integers) return with<Solov2Decoder>(solov2_layout);
  return {};
}

}  // namespace

std::vector<std::string> DecoderConfig::problems() const {
  std::vector<std::string> found;
  if (!(score_threshold > 0.0 && score_threshold < 1.0)) {
    found.emplace_back("score_threshold must be between 0 and 1");
  }
  if (!(nms_iou > 0.0 && nms_iou <= 1.0)) found.emplace_back("nms_iou must be > 0 and at most 1");
  return found;
}

Expected<std::unique_ptr<InstanceDecoder>> make_decoder(const ModelDescription& model,
                                                        const DecoderConfig& config,
                                                        const std::optional<ClassNames>& names) {
  if (const auto size = size_of_input_image(model); !size) return tl::unexpected(size.error());
  const Make make = nearest_layout(model);
  if (!make) {
    return make_error(
        ExitCode::kUnsupportedModel,
        "the outputs are of no layout that is supported: " + to_string(model.outputs) +
            "; supported are SOLOv2 (11 raw outputs, or 3 merged), RTMDet-Ins (dets, "
            "labels, masks) and YOLOv8/11 segmentation (2 outputs): docs/models.md");
  }
  const auto of_model = names ? Expected<ClassNames>(*names) : class_names_of(model);
  if (!of_model) return tl::unexpected(of_model.error());
  return make(model, *of_model, config);
}

}  // namespace tsg
