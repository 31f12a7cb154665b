#include "services/segmentation/lib/yolo_seg_layout.hpp"

#include <cctype>
#include <charconv>
#include <cstddef>
#include <utility>

namespace tsg {

namespace {

constexpr std::size_t kMaxNameBytes = 31;   // what a message has room for
constexpr std::int64_t kLongest = 1 << 20;  // of any dimension; more is a damaged file
constexpr const char* kHowToExport =
    "; a YOLOv8/11 segmentation network is needed, exported to ONNX with a fixed input size "
    "(dynamic=False), batch 1 and without NMS";

tl::unexpected<Error> unsupported(const std::string& what) {
  return make_error(ExitCode::kUnsupportedModel, what + kHowToExport);
}

bool has_fixed_shape(const TensorDescription& tensor, std::size_t rank) {
  if (!tensor.is_float32 || tensor.shape.size() != rank || tensor.shape.front() != 1) return false;
  for (const std::int64_t length : tensor.shape) {
    if (length <= 0 || length > kLongest) return false;
  }
  return true;
}

std::string describe(const std::vector<TensorDescription>& tensors) {
  std::string text;
  for (const auto& tensor : tensors) text += (text.empty() ? "" : ", ") + tensor.to_string();
  return text.empty() ? "none" : text;
}

/// Reads a Python dictionary literal of integer keys and string values from its beginning on.
class DictionaryReader {
 public:
  explicit DictionaryReader(std::string_view text) : text_(text) {}

  bool skip(char expected) {
    skip_blanks();
    if (at_ >= text_.size() || text_[at_] != expected) return false;
    ++at_;
    return true;
  }

  bool read_key(int& key) {
    skip_blanks();
    const char* end = text_.data() + text_.size();
    const auto [next, failure] = std::from_chars(text_.data() + at_, end, key);
    if (failure != std::errc{}) return false;
    at_ = static_cast<std::size_t>(next - text_.data());
    return true;
  }

  bool read_string(std::string& value) {
    value.clear();
    skip_blanks();
    const char quote = at_ < text_.size() ? text_[at_] : '\0';
    if (quote != '\'' && quote != '"') return false;
    while (++at_ < text_.size()) {
      if (text_[at_] == quote) {
        ++at_;
        return true;
      }
      if (text_[at_] == '\\' && at_ + 1 < text_.size()) ++at_;
      value += text_[at_];
    }
    return false;
  }

 private:
  void skip_blanks() {
    while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_])) != 0) ++at_;
  }

  std::string_view text_;
  std::size_t at_ = 0;
};

/// Checks the two outputs against the input and the number of classes.
Expected<void> check_outputs(const YoloSegLayout& layout, const ModelDescription& model) {
  const std::int64_t numbers = model.outputs[0].shape[1];
  if (numbers != kBoxNumbers + layout.classes() + layout.coefficients) {
    return unsupported("the output " + model.outputs[0].to_string() + " should have " +
                       std::to_string(kBoxNumbers + layout.classes() + layout.coefficients) +
                       " numbers per anchor: 4 of the box, " + std::to_string(layout.classes()) +
                       " classes, " + std::to_string(layout.coefficients) + " mask coefficients");
  }
  if (layout.input_size != layout.prototype_size * 4) {
    return unsupported("the mask prototypes " + model.outputs[1].to_string() +
                       " are not a quarter of the input " + model.inputs[0].to_string());
  }
  return {};
}

}  // namespace

std::string TensorDescription::to_string() const {
  std::string text = name + (is_float32 ? " float32 [" : " (not float32) [");
  for (std::size_t i = 0; i < shape.size(); ++i) {
    text += (i == 0 ? "" : ",") + (shape[i] < 0 ? std::string("?") : std::to_string(shape[i]));
  }
  return text + "]";
}

Expected<std::vector<std::string>> parse_class_names(std::string_view dictionary) {
  const auto wrong = [&] {
    return unsupported("the metadata key `names` should read {0: 'person', 1: ...}, not \"" +
                       std::string(dictionary.substr(0, 60)) + "\"");
  };
  DictionaryReader reader(dictionary);
  if (!reader.skip('{')) return wrong();
  std::vector<std::string> names;
  do {
    int key = -1;
    std::string name;
    if (!reader.read_key(key) || key != static_cast<int>(names.size())) return wrong();
    if (!reader.skip(':') || !reader.read_string(name) || name.empty()) return wrong();
    if (name.size() > kMaxNameBytes) {
      return make_error(ExitCode::kUnsupportedModel,
                        "the class name '" + name + "' has more than " +
                            std::to_string(kMaxNameBytes) + " bytes: export with a shorter one");
    }
    names.push_back(std::move(name));
  } while (reader.skip(','));
  if (!reader.skip('}')) return wrong();
  return names;
}

Expected<YoloSegLayout> yolo_seg_layout(const ModelDescription& model) {
  const auto& inputs = model.inputs;
  const auto& outputs = model.outputs;
  if (inputs.size() != 1 || !has_fixed_shape(inputs[0], 4) || inputs[0].shape[1] != 3) {
    return unsupported("the input is not one float32 image [1,3,H,W]: " + describe(inputs));
  }
  if (outputs.size() != 2 || !has_fixed_shape(outputs[0], 3) || !has_fixed_shape(outputs[1], 4)) {
    return unsupported("the outputs are not detections [1,4+C+M,A] and prototypes [1,M,H/4,W/4]: " +
                       describe(outputs));
  }
  const auto names = model.metadata.find("names");
  if (names == model.metadata.end()) {
    return unsupported("the metadata has no key `names` with the classes");
  }
  auto class_names = parse_class_names(names->second);
  if (!class_names) return tl::unexpected(class_names.error());

  YoloSegLayout layout;
  layout.class_names = std::move(*class_names);
  layout.input_size = {static_cast<int>(inputs[0].shape[3]), static_cast<int>(inputs[0].shape[2])};
  layout.prototype_size = {static_cast<int>(outputs[1].shape[3]),
                           static_cast<int>(outputs[1].shape[2])};
  layout.anchors = static_cast<int>(outputs[0].shape[2]);
  layout.coefficients = static_cast<int>(outputs[1].shape[1]);
  if (auto checked = check_outputs(layout, model); !checked) {
    return tl::unexpected(checked.error());
  }
  return layout;
}

}  // namespace tsg
