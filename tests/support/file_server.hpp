#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/support/run_program.hpp"
#include "tests/support/temp_folder.hpp"
#include "tests/support/wait.hpp"

namespace tsg::test {

/// A folder served over HTTP on the loopback interface, as long as the object lives.
class FileServer {
 public:
  /// With `break_after` connections break after so many bytes of every answer.
  explicit FileServer(const std::filesystem::path& folder, std::optional<int> break_after = {})
      : server_("python3", arguments(folder, break_after)) {
    const auto has_port = [&] { return std::filesystem::exists(port_file()); };
    if (!eventually(std::chrono::seconds(20), has_port)) {
      throw std::runtime_error("no file server: " + server_.output());
    }
  }

  [[nodiscard]] std::string url() const { return "http://127.0.0.1:" + content_of(port_file()); }
  /// A line for each request: "GET PATH FIRST_BYTE".
  [[nodiscard]] std::string requests() const { return server_.output(); }

 private:
  [[nodiscard]] std::filesystem::path port_file() const { return folder_ / "port"; }
  [[nodiscard]] std::vector<std::string> arguments(const std::filesystem::path& folder,
                                                   std::optional<int> break_after) const {
    std::vector<std::string> list{TSG_SOURCE_DIR "/tests/support/file_server.py", folder.string(),
                                  port_file().string()};
    if (break_after) list.push_back(std::to_string(*break_after));
    return list;
  }

  TempFolder folder_;
  RunningProgram server_;
};

}  // namespace tsg::test
