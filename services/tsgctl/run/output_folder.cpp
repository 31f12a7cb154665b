#include "services/tsgctl/run/output_folder.hpp"

#include <array>
#include <system_error>
#include <utility>

#include "common/core/atomic_file.hpp"
#include "common/core/error.hpp"
#include "services/tsgctl/lib/text_format.hpp"

namespace tsg {
namespace {

namespace fs = std::filesystem;

/// All that a run may write, in the order of the summary.
constexpr std::array<const char*, 9> kFileNames{
    "trajectory.txt", "trajectory_live.txt", "keyframes.txt", "map.ot", "map.bt", "cloud.ply",
    "map.png",        "trajectory.png",      "report.json"};
constexpr std::array<const char*, 5> kLogNames{"roudi.log", "segmentation.log", "slam.log",
                                               "map_server.log", "camera.log"};

/// A minute of a room takes about this.
constexpr std::uintmax_t kRoomForARun = 16'000'000;

/// Writing is the only test that holds for every reason: permissions, read-only mounts, quotas.
void check_writable(const fs::path& folder) {
  const fs::path probe = folder / ".writable";
  throw_on_error(write_file_atomically(probe, "x"));
  std::error_code ignored;
  fs::remove(probe, ignored);
}

void check_room(const fs::path& folder) {
  std::error_code error;
  const fs::space_info space = fs::space(folder, error);
  if (error || space.available >= kRoomForARun) return;
  throw FatalError(ExitCode::kCannotWrite,
                   folder.string() + ": only " + format_bytes(space.available) +
                       " left on the disk; a run needs at least " + format_bytes(kRoomForARun) +
                       ": make room, or choose another --out");
}

}  // namespace

OutputFolder::OutputFolder(fs::path path) : path_(std::move(path)) {
  throw_on_error(make_folder(logs()));
  std::error_code ignored;  // what cannot be removed cannot be written either: told below
  for (const char* name : kFileNames) fs::remove(path_ / name, ignored);
  for (const char* name : kLogNames) fs::remove(logs() / name, ignored);
  check_room(path_);
  check_writable(path_);
}

std::vector<OutputFile> OutputFolder::files() const {
  std::vector<OutputFile> files;
  for (const char* name : kFileNames) {
    std::error_code error;
    const std::uintmax_t bytes = fs::file_size(path_ / name, error);
    if (!error) files.push_back({name, bytes});
  }
  return files;
}

}  // namespace tsg
