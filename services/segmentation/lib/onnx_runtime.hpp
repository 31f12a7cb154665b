#pragma once

#include <string>

#include "common/core/error.hpp"

namespace tsg {

/// Loads ONNX Runtime into the process and binds its C++ interface to it; once loaded it stays.
/// `library` is a path; empty: the one found at build time, else whatever the loader finds.
/// kUnavailable, with the fix, where there is none or one older than our headers.
Expected<void> load_onnx_runtime(const std::string& library);

}  // namespace tsg
