#include "services/segmentation/lib/onnx_runtime.hpp"

#include <dlfcn.h>

#include <filesystem>

#define ORT_API_MANUAL_INIT
#include <onnxruntime_cxx_api.h>

namespace tsg {

namespace {

constexpr const char* kFix =
    "; run deploy/install-deps, or name the library in segmentation.model.runtime_library";

std::string library_to_load(const std::string& configured) {
  if (!configured.empty()) return configured;
  std::error_code ignored;  // a path that cannot be looked at is one that is not there
  if (std::filesystem::exists(TSG_ONNXRUNTIME_LIBRARY, ignored)) return TSG_ONNXRUNTIME_LIBRARY;
  return "libonnxruntime.so.1";
}

}  // namespace

Expected<void> load_onnx_runtime(const std::string& library) {
  const std::string path = library_to_load(library);
  // Never closed: the runtime keeps threads and thread-local data beyond its last object.
  void* handle = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (handle == nullptr) {
    const char* why = dlerror();  // NOLINT(concurrency-mt-unsafe): thread-local in glibc
    return make_error(ExitCode::kUnavailable,
                      "cannot load ONNX Runtime: " + std::string(why) + kFix);
  }
  using GetApiBase = const OrtApiBase* (*)();
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-reinterpret-cast): how dlsym gives functions
  const auto get_api_base = reinterpret_cast<GetApiBase>(dlsym(handle, "OrtGetApiBase"));
  if (get_api_base == nullptr) {
    return make_error(ExitCode::kUnavailable, path + " is not ONNX Runtime" + kFix);
  }
  const OrtApiBase* base = get_api_base();
  const OrtApi* api = base->GetApi(ORT_API_VERSION);
  if (api == nullptr) {
    return make_error(ExitCode::kUnavailable, path + " is ONNX Runtime " +
                                                  base->GetVersionString() + ", older than the 1." +
                                                  std::to_string(ORT_API_VERSION) +
                                                  " that this program was built for" + kFix);
  }
  Ort::InitApi(api);
  return {};
}

}  // namespace tsg
