#include "services/tsgctl/gnuplot.hpp"

#include <chrono>
#include <cstdlib>

#include "common/app/child_process.hpp"
#include "common/core/atomic_file.hpp"
#include "common/dataset/text_file.hpp"

namespace tsg {
namespace {

namespace fs = std::filesystem;

/// A folder that goes away with this object.
class ScratchFolder {
 public:
  ScratchFolder() : path_((fs::temp_directory_path() / "tsgctl_plot_XXXXXX").string()) {
    if (::mkdtemp(path_.data()) == nullptr) path_.clear();
  }
  ~ScratchFolder() {
    std::error_code ignored;
    if (!path_.empty()) fs::remove_all(path_, ignored);
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  ScratchFolder(ScratchFolder&&) = delete;
  ScratchFolder& operator=(ScratchFolder&&) = delete;

  [[nodiscard]] fs::path path() const { return path_; }

 private:
  std::string path_;
};

Expected<void> run_gnuplot(const fs::path& script, const fs::path& log) {
  auto gnuplot = ChildProcess::spawn(
      {.program = "gnuplot", .arguments = {script.string()}, .output_file = log});
  if (!gnuplot) {
    return make_error(ExitCode::kUnavailable,
                      "plots need gnuplot, which is not installed; apt-get install gnuplot-nox");
  }
  const auto& end = gnuplot->wait(std::chrono::seconds(60));
  if (end && end->is_success()) return {};
  const auto said = read_text_file(log, "");
  return make_error(ExitCode::kUnavailable,
                    "gnuplot failed: " + (end ? end->describe() : "no end after 60 s") + ": " +
                        said.value_or("") + "; reinstall gnuplot-nox");
}

}  // namespace

std::string gnuplot_text(const std::string& text) {
  std::string result = "'";
  for (const char character : text) {
    if (character == '\'') result += '\'';
    if (character != '\n') result += character;
  }
  return result + "'";
}

Expected<void> draw_png(const std::function<std::string(const fs::path& picture)>& script_for,
                        const fs::path& png) {
  const ScratchFolder scratch;
  if (scratch.path().empty()) {
    return make_error(ExitCode::kCannotWrite, "cannot make a folder in " +
                                                  fs::temp_directory_path().string() +
                                                  "; free some disk space or set TMPDIR");
  }
  const fs::path picture = scratch.path() / "plot.png";
  const fs::path script = scratch.path() / "plot.gp";
  return write_file_atomically(script, script_for(picture))
      .and_then([&] { return run_gnuplot(script, scratch.path() / "gnuplot.log"); })
      .and_then([&] { return read_text_file(picture, "reinstall gnuplot-nox"); })
      .and_then([&](const std::string& bytes) { return write_file_atomically(png, bytes); });
}

}  // namespace tsg
