#include "services/tsgctl/model/model_check.hpp"

#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>
#include <utility>

#include "common/core/time.hpp"
#include "services/tsgctl/lib/text_format.hpp"

namespace tsg {

namespace {

const char* to_text(ChannelOrder order) { return order == ChannelOrder::kRgb ? "RGB" : "BGR"; }

std::string to_text(cv::Size size) {
  return std::to_string(size.width) + " x " + std::to_string(size.height);
}

std::string joined(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

/// "scaled to fit, at the top left, RGB".
std::string how_shown(const InputFormat& format) {
  const std::string where =
      format.placement == Placement::kCentred ? "in the middle" : "at the top left";
  return "frames scaled to fit " + to_text(format.size) + ", " + where + ", as " +
         to_text(format.order);
}

std::string to_text(const SegmentationTimes& times, int threads) {
  return fixed(to_milliseconds(times.network_ns), 1) + " ms for the network on " +
         std::to_string(threads) + (threads == 1 ? " thread" : " threads") + ", " +
         fixed(to_milliseconds(times.preprocess_ns), 1) + " ms before and " +
         fixed(to_milliseconds(times.postprocess_ns), 1) + " ms after it";
}

}  // namespace

Expected<ModelCheck> check_model(const ModelProviderConfig& config) {
  auto provider = ModelProvider::make(config);
  if (!provider) return tl::unexpected(provider.error());
  cv::Mat noise(480, 640, CV_8UC3);
  cv::RNG random(1);
  random.fill(noise, cv::RNG::UNIFORM, 0, 256);
  const RgbdFrame frame{.seq = 0, .stamp_ns = 0, .camera = {}, .colour = noise, .depth = {}};
  cv::Mat labels;
  auto result = (*provider)->segment(frame, labels);
  if (result) result = (*provider)->segment(frame, labels);  // the first run makes memory as well
  if (!result) {
    return make_error(result.error().code, "the model " + config.model.file +
                                               ", run on noise: " + result.error().message);
  }
  const InstanceDecoder& decoder = (*provider)->decoder();
  const ModelDescription& description = (*provider)->description();
  return ModelCheck{.file = config.model.file,
                    .layout = decoder.layout_name(),
                    .input = to_string(description.inputs),
                    .outputs = to_string(description.outputs),
                    .format = decoder.input_format(),
                    .classes = decoder.class_names(),
                    .class_source = config.labels_file.empty() ? "metadata" : config.labels_file,
                    .threads = config.model.threads,
                    .instances_in_noise = static_cast<int>(result->segmentation.instances.size()),
                    .times = result->times};
}

std::string to_text(const ModelCheck& check) {
  return check.file + ": a network that the segmentation service can run\n" +
         format_table({{"layout", check.layout},
                       {"input", check.input},
                       {"outputs", check.outputs},
                       {"is shown", how_shown(check.format)},
                       {"classes", std::to_string(check.classes.size()) + ", from " +
                                       check.class_source + ": " + joined(check.classes)},
                       {"in noise", std::to_string(check.instances_in_noise) + " instances"},
                       {"one frame", to_text(check.times, check.threads)}},
                      2);
}

nlohmann::json to_json(const ModelCheck& check) {
  return {{"file", check.file},
          {"layout", check.layout},
          {"input", check.input},
          {"outputs", check.outputs},
          {"width", check.format.size.width},
          {"height", check.format.size.height},
          {"channels", to_text(check.format.order)},
          {"classes", check.classes},
          {"class_source", check.class_source},
          {"threads", check.threads},
          {"instances_in_noise", check.instances_in_noise},
          {"preprocess_ms", to_milliseconds(check.times.preprocess_ns)},
          {"network_ms", to_milliseconds(check.times.network_ns)},
          {"postprocess_ms", to_milliseconds(check.times.postprocess_ns)}};
}

}  // namespace tsg
