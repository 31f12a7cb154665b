#include "services/segmentation/lib/decoders/solov2_layout.hpp"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <utility>

#include "services/segmentation/lib/decoders/input_image.hpp"

namespace tsg {

namespace {

constexpr std::size_t kLevels = 5;
constexpr std::array<int, kLevels> kStrides{8, 8, 16, 32, 32};
constexpr std::array<int, kLevels> kPublishedGrids{40, 36, 24, 16, 12};
constexpr std::int64_t kPublishedCells = 3872;  // of these grids
constexpr std::size_t kRawOutputs = 2 * kLevels + 1;
constexpr std::size_t kMergedOutputs = 3;
constexpr const char* kHowToExportSolov2 =
    "; a SOLOv2 network is to be exported as 11 raw outputs (5 of class scores [1,C,S,S], 5 of "
    "kernels [1,E,S,S], the feature [1,E,H/4,W/4]) or merged (scores [3872,C], kernels [3872,E], "
    "feature [1,E,H/4,W/4]), with a fixed input size";

tl::unexpected<Error> no_solov2(const std::string& what, const ModelDescription& model) {
  return make_error(ExitCode::kUnsupportedModel,
                    what + ": " + to_string(model.outputs) + kHowToExportSolov2);
}

/// An output with what its shape says, without a leading 1.
struct Output {
  std::size_t index = 0;
  const TensorDescription* tensor = nullptr;
  std::vector<std::int64_t> shape;

  [[nodiscard]] bool is_feature(cv::Size mask_size) const {
    return shape.size() == 3 && shape[1] == mask_size.height && shape[2] == mask_size.width;
  }
  [[nodiscard]] bool is_grid() const { return shape.size() == 3 && shape[1] == shape[2]; }
  [[nodiscard]] bool name_has(const char* part) const {
    return tensor->name.find(part) != std::string::npos;
  }
};

std::vector<Output> outputs_of(const ModelDescription& model) {
  std::vector<Output> outputs;
  for (std::size_t i = 0; i < model.outputs.size(); ++i) {
    const TensorDescription& tensor = model.outputs[i];
    outputs.push_back({.index = i, .tensor = &tensor, .shape = tensor.shape});
    std::vector<std::int64_t>& shape = outputs.back().shape;
    // A feature of a single channel, [1,h,w], may look like a batch: no published network has one.
    const bool has_batch = shape.size() == 4 || (shape.size() == 3 && model.outputs.size() == 3);
    if (has_batch && shape.front() == 1) shape.erase(shape.begin());
  }
  return outputs;
}

struct Split {
  std::vector<Output> categories;
  std::vector<Output> kernels;
};

/// Tells scores from kernels, by their numbers of channels C and E, which `axis` of the shapes has.
/// Where these are equal (80 classes and kernels of 80, say) nothing in the shapes tells: then
/// names with "kernel" are believed, and else the order in which SOLOv2's head returns them, which
/// is scores first: of outputs of one shape the first half.
Split split(const std::vector<Output>& outputs, std::size_t axis, std::int64_t kernel_length) {
  const auto has_kernel_length = [&](const Output& o) { return o.shape[axis] == kernel_length; };
  const auto is_named = [](const Output& o) { return o.name_has("kernel"); };
  const bool shapes_tell = !std::all_of(outputs.begin(), outputs.end(), has_kernel_length);
  const bool names_tell = std::any_of(outputs.begin(), outputs.end(), is_named);
  Split split;
  for (auto output = outputs.begin(); output != outputs.end(); ++output) {
    const auto is_alike = [&](const Output& other) { return other.shape == output->shape; };
    const auto alike = std::count_if(outputs.begin(), outputs.end(), is_alike);
    const auto before = std::count_if(outputs.begin(), output, is_alike);
    const bool is_kernel = shapes_tell  ? has_kernel_length(*output)
                           : names_tell ? is_named(*output)
                                        : 2 * before >= alike;
    (is_kernel ? split.kernels : split.categories).push_back(*output);
  }
  return split;
}

/// The grids of raw outputs, the feature being left out of `outputs`; none where they do not pair.
std::optional<std::array<Solov2Grid, kLevels>> raw_grids(const std::vector<Output>& outputs,
                                                         std::int64_t kernel_length) {
  if (!std::all_of(outputs.begin(), outputs.end(), [](const Output& o) { return o.is_grid(); })) {
    return std::nullopt;
  }
  auto [categories, kernels] = split(outputs, 0, kernel_length);
  if (categories.size() != kLevels || kernels.size() != kLevels) return std::nullopt;
  const auto is_finer = [](const Output& a, const Output& b) { return a.shape[1] > b.shape[1]; };
  std::stable_sort(categories.begin(), categories.end(), is_finer);
  std::stable_sort(kernels.begin(), kernels.end(), is_finer);
  std::array<Solov2Grid, kLevels> grids{};
  for (std::size_t level = 0; level < kLevels; ++level) {
    const std::vector<std::int64_t>& shape = categories[level].shape;
    if (shape[1] != kernels[level].shape[1] || shape[0] != categories[0].shape[0]) {
      return std::nullopt;
    }
    grids.at(level) = {.size = static_cast<int>(shape[1]),
                       .stride = kStrides.at(level),
                       .first_cell = 0,
                       .categories = categories[level].index,
                       .kernels = kernels[level].index};
  }
  return grids;
}

/// Fills in feature and grids; the number of classes, or none where the outputs are no raw SOLOv2.
std::optional<std::int64_t> find_raw(const std::vector<Output>& outputs, Solov2Layout& layout) {
  // The last first: where a grid is as large as the feature, the head returns this one at the end.
  for (std::size_t i = outputs.size(); i > 0; --i) {
    const Output& feature = outputs[i - 1];
    if (!feature.is_feature(layout.mask_size)) continue;
    std::vector<Output> others = outputs;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(i - 1));
    const auto grids = raw_grids(others, feature.shape[0]);
    if (!grids) continue;
    layout.feature = feature.index;
    layout.kernel_length = static_cast<int>(feature.shape[0]);
    layout.grids = *grids;
    return outputs[layout.grids[0].categories].shape[0];
  }
  return std::nullopt;
}

std::array<Solov2Grid, kLevels> merged_grids(std::size_t categories, std::size_t kernels) {
  std::array<Solov2Grid, kLevels> grids{};
  std::size_t first_cell = 0;
  for (std::size_t level = 0; level < kLevels; ++level) {
    const int size = kPublishedGrids.at(level);
    grids.at(level) = {.size = size,
                       .stride = kStrides.at(level),
                       .first_cell = first_cell,
                       .categories = categories,
                       .kernels = kernels};
    first_cell += static_cast<std::size_t>(size) * static_cast<std::size_t>(size);
  }
  return grids;
}

/// The same for merged outputs.
std::optional<std::int64_t> find_merged(std::vector<Output> outputs, Solov2Layout& layout) {
  const auto feature = std::find_if(outputs.begin(), outputs.end(), [&](const Output& output) {
    return output.is_feature(layout.mask_size);
  });
  if (feature == outputs.end()) return std::nullopt;
  layout.is_merged = true;
  layout.feature = feature->index;
  layout.kernel_length = static_cast<int>(feature->shape[0]);
  outputs.erase(feature);
  for (const Output& output : outputs) {
    if (output.shape.size() != 2 || output.shape[0] != kPublishedCells) return std::nullopt;
  }
  const auto [categories, kernels] = split(outputs, 1, layout.kernel_length);
  if (categories.size() != 1 || kernels.size() != 1) return std::nullopt;
  layout.grids = merged_grids(categories[0].index, kernels[0].index);
  return categories[0].shape[1];
}

}  // namespace

Expected<Solov2Layout> solov2_layout(const ModelDescription& model, const ClassNames& names) {
  const auto input_size = size_of_input_image(model);
  if (!input_size) return tl::unexpected(input_size.error());
  for (const TensorDescription& output : model.outputs) {
    if (output.type != ElementType::kFloat32 || !output.has_fixed_shape()) {
      return no_solov2("the outputs are not all float32 of fixed shape", model);
    }
  }
  Solov2Layout layout;
  layout.input_size = *input_size;
  layout.mask_size = *input_size / 4;
  layout.class_names = names.names;
  if (layout.mask_size * 4 != *input_size) {
    return no_solov2("width and height of the input are not multiples of 4", model);
  }
  std::optional<std::int64_t> classes;
  if (model.outputs.size() == kRawOutputs) classes = find_raw(outputs_of(model), layout);
  if (model.outputs.size() == kMergedOutputs) classes = find_merged(outputs_of(model), layout);
  if (!classes) return no_solov2("the outputs are not those of SOLOv2", model);
  if (auto counted = check_class_count(names, *classes); !counted) {
    return tl::unexpected(counted.error());
  }
  return layout;
}

}  // namespace tsg
