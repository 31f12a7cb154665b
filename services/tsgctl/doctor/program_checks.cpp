#include "services/tsgctl/doctor/program_checks.hpp"

#include <dlfcn.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <sstream>
#include <string>

#include "common/app/shipped_files.hpp"

namespace tsg {
namespace {

namespace fs = std::filesystem;

std::optional<fs::path> find_in_path(const std::string& program) {
  const char* path = std::getenv("PATH");  // NOLINT(concurrency-mt-unsafe): nobody sets it
  std::istringstream folders(path == nullptr ? "/usr/bin:/bin" : path);
  for (std::string folder; std::getline(folders, folder, ':');) {
    const fs::path candidate = fs::path(folder) / program;
    if (access(candidate.c_str(), X_OK) == 0) return candidate;
  }
  return std::nullopt;
}

CheckResult check_services() {
  constexpr std::array<const char*, 4> kPrograms{"tsg-camera", "tsg-segmentation", "tsg-slam",
                                                 "tsg-map-server"};
  const fs::path folder = program_folder();
  std::string missing;
  for (const char* program : kPrograms) {
    if (access((folder / program).c_str(), X_OK) != 0) missing += std::string(" ") + program;
  }
  if (missing.empty()) return passed("services", "all four are in " + folder.string());
  return failed("services", "not in " + folder.string() + ":" + missing,
                "build all of it: cmake --build build/release; or install it again");
}

CheckResult check_roudi_program() {
  if (const auto program = find_in_path("iox-roudi")) {
    return passed("RouDi program", program->string());
  }
  return failed("RouDi program", "iox-roudi is not in PATH", "apt-get install iceoryx");
}

CheckResult check_roudi_config() {
  const auto config = find_config_file("roudi.toml");
  if (config) return passed("RouDi configuration", config->string());
  return failed("RouDi configuration", config.error().message, "install TSG-SLAM again");
}

CheckResult check_gnuplot() {
  if (const auto program = find_in_path("gnuplot")) return passed("gnuplot", program->string());
  return warned("gnuplot", "is not in PATH: no plots of trajectories",
                "apt-get install gnuplot-nox");
}

CheckResult check_onnx_runtime() {
  for (const char* library : {TSG_ONNXRUNTIME_LIBRARY, "libonnxruntime.so.1"}) {
    void* handle = dlopen(library, RTLD_LAZY | RTLD_LOCAL);
    if (handle == nullptr) continue;
    const bool is_it = dlsym(handle, "OrtGetApiBase") != nullptr;
    dlclose(handle);
    if (is_it) return passed("ONNX Runtime", library);
  }
  return warned("ONNX Runtime", "cannot be loaded: no --segmentation model",
                "deploy/install-onnxruntime");
}

}  // namespace

std::vector<CheckResult> check_programs() {
  return {check_services(), check_roudi_program(), check_roudi_config(), check_gnuplot(),
          check_onnx_runtime()};
}

}  // namespace tsg
