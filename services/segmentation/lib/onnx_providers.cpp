#include "services/segmentation/lib/onnx_providers.hpp"

#include <algorithm>
#include <memory>
#include <vector>

namespace tsg {

namespace {

/// The runtime's own name of it.
std::string runtime_name(const std::string& provider) {
  return provider == "cuda" ? "CUDAExecutionProvider" : "TensorrtExecutionProvider";
}

void check_built_in(const std::string& provider) {
  const std::vector<std::string> built_in = Ort::GetAvailableProviders();
  const std::string wanted = runtime_name(provider);
  if (std::find(built_in.begin(), built_in.end(), wanted) != built_in.end()) return;
  std::string all;
  for (const std::string& name : built_in) all += (all.empty() ? "" : ", ") + name;
  throw Ort::Exception("this ONNX Runtime is built without " + wanted + " (it has " + all + ")",
                       ORT_NOT_IMPLEMENTED);
}

void append_cuda(Ort::SessionOptions& options) {
  const OrtApi& api = Ort::GetApi();
  OrtCUDAProviderOptionsV2* created = nullptr;
  Ort::ThrowOnError(api.CreateCUDAProviderOptions(&created));
  const std::unique_ptr<OrtCUDAProviderOptionsV2, decltype(api.ReleaseCUDAProviderOptions)> cuda(
      created, api.ReleaseCUDAProviderOptions);
  options.AppendExecutionProvider_CUDA_V2(*cuda);
}

void append_tensorrt(Ort::SessionOptions& options) {
  const OrtApi& api = Ort::GetApi();
  OrtTensorRTProviderOptionsV2* created = nullptr;
  Ort::ThrowOnError(api.CreateTensorRTProviderOptions(&created));
  const std::unique_ptr<OrtTensorRTProviderOptionsV2, decltype(api.ReleaseTensorRTProviderOptions)>
      tensorrt(created, api.ReleaseTensorRTProviderOptions);
  options.AppendExecutionProvider_TensorRT_V2(*tensorrt);
}

}  // namespace

void append_provider(const std::string& provider, Ort::SessionOptions& options) {
  if (provider == "cpu") return;  // always there, for what the others cannot do too
  check_built_in(provider);
  if (provider == "tensorrt") append_tensorrt(options);
  append_cuda(options);  // with TensorRT: for the layers that it lacks
}

std::string provider_failed(const std::string& provider, const std::string& why) {
  return "the network does not run on " + provider + ", which segmentation.model.provider asks " +
         "for: " + why +
         "; install ONNX Runtime for GPUs with what it needs, name its libonnxruntime.so in "
         "segmentation.model.runtime_library, or set segmentation.model.provider=cpu";
}

}  // namespace tsg
