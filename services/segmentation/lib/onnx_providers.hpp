#pragma once

#include <string>

#define ORT_API_MANUAL_INIT
#include <onnxruntime_cxx_api.h>

namespace tsg {

/// Makes sessions of `options` run on `provider` ("cpu", "cuda" or "tensorrt"). Throws
/// Ort::Exception where the loaded runtime lacks it, or something that it needs.
void append_provider(const std::string& provider, Ort::SessionOptions& options);

/// Why the network does not run there, and what to do.
[[nodiscard]] std::string provider_failed(const std::string& provider, const std::string& why);

}  // namespace tsg
