#include "services/segmentation/lib/onnx_model.hpp"

#include <algorithm>
#include <functional>
#include <numeric>
#include <utility>

#include "services/segmentation/lib/onnx_providers.hpp"
#include "services/segmentation/lib/onnx_runtime.hpp"

namespace tsg {

namespace {

/// A tensor whose memory is ours and stays where it is between runs. An output of no fixed shape
/// has none: the runtime makes its memory in each run.
struct BoundTensor {
  std::vector<float> floats;
  std::vector<std::int64_t> integers;
  Ort::Value view{nullptr};
};

Ort::SessionOptions session_options(const OnnxModelConfig& config) {
  Ort::SessionOptions options;
  options.SetIntraOpNumThreads(config.threads);
  options.SetInterOpNumThreads(1);
  options.SetGraphOptimizationLevel(ORT_ENABLE_ALL);
  // A waiting thread would otherwise spin on a core that tracking needs.
  options.AddConfigEntry("session.intra_op.allow_spinning", "0");
  // Weights stored as int8 are computed with as float32: as fast here, and the same result.
  options.AddConfigEntry("session.disable_quant_qdq", "1");
  append_provider(config.provider, options);
  return options;
}

TensorDescription describe(std::string name, const Ort::TypeInfo& type) {
  TensorDescription tensor{.name = std::move(name), .shape = {}, .type = ElementType::kOther};
  if (type.GetONNXType() != ONNX_TYPE_TENSOR) return tensor;
  const auto info = type.GetTensorTypeAndShapeInfo();
  tensor.shape = info.GetShape();
  const auto type_of_elements = info.GetElementType();
  if (type_of_elements == ONNX_TENSOR_ELEMENT_DATA_TYPE_FLOAT) tensor.type = ElementType::kFloat32;
  if (type_of_elements == ONNX_TENSOR_ELEMENT_DATA_TYPE_INT64) tensor.type = ElementType::kInt64;
  return tensor;
}

ModelDescription describe(const Ort::Session& session) {
  Ort::AllocatorWithDefaultOptions allocator;
  ModelDescription model;
  for (std::size_t i = 0; i < session.GetInputCount(); ++i) {
    model.inputs.push_back(
        describe(session.GetInputNameAllocated(i, allocator).get(), session.GetInputTypeInfo(i)));
  }
  for (std::size_t i = 0; i < session.GetOutputCount(); ++i) {
    model.outputs.push_back(
        describe(session.GetOutputNameAllocated(i, allocator).get(), session.GetOutputTypeInfo(i)));
  }
  const Ort::ModelMetadata metadata = session.GetModelMetadata();
  for (const auto& key : metadata.GetCustomMetadataMapKeysAllocated(allocator)) {
    const auto value = metadata.LookupCustomMetadataMapAllocated(key.get(), allocator);
    if (value) model.metadata.emplace(key.get(), value.get());
  }
  return model;
}

tl::unexpected<Error> loading_failed(const std::string& file, const Ort::Exception& failure) {
  switch (failure.GetOrtErrorCode()) {
    case ORT_NO_SUCHFILE:
      return make_error(ExitCode::kMissingInput,
                        "cannot read the model " + file + ": " + failure.what());
    case ORT_INVALID_PROTOBUF:
      return make_error(ExitCode::kBadData, "the model " + file +
                                                " is not an ONNX file or is damaged (" +
                                                failure.what() + "); fetch or export it anew");
    default:
      return make_error(ExitCode::kUnsupportedModel,
                        "ONNX Runtime cannot run the model " + file + ": " + failure.what() +
                            "; export it anew with the operators of ONNX opset 13");
  }
}

Expected<void> check_file(const std::string& file) {
  std::error_code failure;
  if (!std::filesystem::is_regular_file(file, failure)) {
    return make_error(ExitCode::kMissingInput,
                      "there is no model file " + file + ": set segmentation.model.file");
  }
  if (std::filesystem::file_size(file, failure) == 0) {
    return make_error(ExitCode::kBadData,
                      "the model " + file + " is empty; fetch or export it anew");
  }
  return {};
}

Ort::MemoryInfo own_memory() {
  return Ort::MemoryInfo::CreateCpu(OrtDeviceAllocator, OrtMemTypeDefault);
}

template <typename T>
Ort::Value allocate_as(const TensorDescription& tensor, std::vector<T>& values) {
  const auto count = std::accumulate(tensor.shape.begin(), tensor.shape.end(), std::int64_t{1},
                                     std::multiplies<>());
  values.resize(static_cast<std::size_t>(count));
  return Ort::Value::CreateTensor<T>(own_memory(), values.data(), values.size(),
                                     tensor.shape.data(), tensor.shape.size());
}

/// `tensor` has a fixed shape.
BoundTensor allocate_one(const TensorDescription& tensor) {
  BoundTensor bound;
  bound.view = tensor.type == ElementType::kInt64 ? allocate_as(tensor, bound.integers)
                                                  : allocate_as(tensor, bound.floats);
  return bound;
}

tl::unexpected<Error> unusable(const TensorDescription& tensor, const std::string& why) {
  return make_error(ExitCode::kUnsupportedModel, "the tensor " + tensor.to_string() +
                                                     " of the model " + why + "; export it anew");
}

TensorView view_of(const Ort::Value& value) {
  const auto info = value.GetTensorTypeAndShapeInfo();
  TensorView view{.shape = info.GetShape(), .floats = {}, .integers = {}};
  const std::size_t count = info.GetElementCount();
  if (info.GetElementType() == ONNX_TENSOR_ELEMENT_DATA_TYPE_INT64) {
    view.integers = {value.GetTensorData<std::int64_t>(), count};
  } else {
    view.floats = {value.GetTensorData<float>(), count};
  }
  return view;
}

}  // namespace

struct OnnxModel::Impl {
  /// Throws Ort::Exception where the runtime cannot run the file on config.provider.
  explicit Impl(const OnnxModelConfig& config)
      // Failures come as exceptions, so that nothing is written to stderr behind our back.
      : environment(ORT_LOGGING_LEVEL_FATAL, "tsg"),
        session(environment, config.file.c_str(), session_options(config)),
        description(describe(session)),
        runs_on{.name = config.provider, .why_not_wanted = {}} {}

  Ort::Env environment;
  Ort::Session session;
  ModelDescription description;
  ExecutionProvider runs_on;
  Ort::RunOptions run_options;
  std::vector<BoundTensor> inputs;
  std::vector<BoundTensor> outputs;
  std::vector<Ort::Value> results;  ///< of the last run; those of fixed shape view `outputs`
  std::vector<TensorView> views;

  void run() {
    Ort::IoBinding binding(session);
    for (std::size_t i = 0; i < inputs.size(); ++i) {
      binding.BindInput(description.inputs[i].name.c_str(), inputs[i].view);
    }
    for (std::size_t i = 0; i < outputs.size(); ++i) {
      const char* name = description.outputs[i].name.c_str();
      if (outputs[i].view != nullptr) {
        binding.BindOutput(name, outputs[i].view);
      } else {
        binding.BindOutput(name, own_memory());
      }
    }
    session.Run(run_options, binding);
    results = binding.GetOutputValues();
    for (const Ort::Value& result : results) views.push_back(view_of(result));
  }
};

std::vector<std::string> OnnxModelConfig::problems() const {
  std::vector<std::string> found;
  if (threads < 1 || threads > 64) found.emplace_back("threads must be 1 to 64");
  if (provider != "cpu" && provider != "cuda" && provider != "tensorrt") {
    found.emplace_back("provider must be cpu, cuda or tensorrt, not '" + provider + "'");
  }
  return found;
}

OnnxModel::OnnxModel(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
OnnxModel::~OnnxModel() = default;
OnnxModel::OnnxModel(OnnxModel&& other) noexcept = default;
OnnxModel& OnnxModel::operator=(OnnxModel&& other) noexcept = default;

Expected<OnnxModel> OnnxModel::load(const OnnxModelConfig& config) {
  if (auto file = check_file(config.file); !file) return tl::unexpected(file.error());
  if (auto runtime = load_onnx_runtime(config.runtime_library); !runtime) {
    return tl::unexpected(runtime.error());
  }
  try {
    return OnnxModel(std::make_unique<Impl>(config));
  } catch (const Ort::Exception& failure) {
    if (config.provider == "cpu") return loading_failed(config.file, failure);
    return load_on_cpu(config, failure.what());
  }
}

/// `why_not` is what the runtime says of the provider that was asked for.
Expected<OnnxModel> OnnxModel::load_on_cpu(const OnnxModelConfig& config,
                                           const std::string& why_not) {
  const std::string problem = provider_failed(config.provider, why_not);
  OnnxModelConfig on_cpu = config;
  on_cpu.provider = "cpu";
  try {
    auto impl = std::make_unique<Impl>(on_cpu);
    if (config.provider_required) return make_error(ExitCode::kUnavailable, problem);
    impl->runs_on.why_not_wanted = problem;
    return OnnxModel(std::move(impl));
  } catch (const Ort::Exception& failure) {  // then it was not the provider's fault
    return loading_failed(config.file, failure);
  }
}

const ExecutionProvider& OnnxModel::execution_provider() const { return impl_->runs_on; }

const ModelDescription& OnnxModel::description() const { return impl_->description; }

Expected<void> OnnxModel::allocate() {
  std::vector<BoundTensor> inputs;
  for (const auto& tensor : impl_->description.inputs) {
    if (tensor.type != ElementType::kFloat32 || !tensor.has_fixed_shape()) {
      return unusable(tensor, "is not float32 of fixed shape");
    }
    inputs.push_back(allocate_one(tensor));
  }
  std::vector<BoundTensor> outputs;
  for (const auto& tensor : impl_->description.outputs) {
    if (tensor.type == ElementType::kOther) return unusable(tensor, "is of a type not known here");
    outputs.push_back(tensor.has_fixed_shape() ? allocate_one(tensor) : BoundTensor{});
  }
  impl_->inputs = std::move(inputs);
  impl_->outputs = std::move(outputs);
  return {};
}

std::span<float> OnnxModel::input(std::size_t index) { return impl_->inputs.at(index).floats; }

std::span<const TensorView> OnnxModel::outputs() const { return impl_->views; }

Expected<void> OnnxModel::run() {
  impl_->views.clear();
  try {
    impl_->run();
    return {};
  } catch (const Ort::Exception& failure) {
    return make_error(ExitCode::kFailure, std::string("the network failed: ") + failure.what());
  }
}

void OnnxModel::cancel() { impl_->run_options.SetTerminate(); }

}  // namespace tsg
