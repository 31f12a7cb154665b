#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "tests/support/run_program.hpp"
#include "tests/support/temp_folder.hpp"
#include "tests/support/wait.hpp"

namespace tsg::test {

/// A second host, as far as networks go, at the other end of a cable that can be made bad: this one
/// has interface robot0, the other base0. Needs tests/support/own_host around the test.
class TwoHosts {
 public:
  TwoHosts() : other_("unshare", {"--net", "sleep", "infinity"}) {
    set_link(0, 0.0);
    if (!eventually(std::chrono::seconds(5), [this] { return has_own_network(); })) return;
    link_.emplace("python3", std::vector<std::string>{TSG_SOURCE_DIR "/tests/support/bad_link.py",
                                                      std::to_string(other_.child().pid()),
                                                      (folder_ / "control").string()});
    (void)eventually(std::chrono::seconds(10),
                     [this] { return link_->output() == "up\n" || link_->child().poll(); });
  }

  /// Whether there is such a cable; not where namespaces or tunnels are not permitted.
  [[nodiscard]] bool is_there() const { return link_ && link_->output() == "up\n"; }
  [[nodiscard]] std::string why_not() const {
    return link_ ? link_->output() : "no network namespaces are permitted here";
  }

  /// Packets take so long each way, and a share of them is lost.
  void set_link(int delay_ms, double loss) {
    write_control(std::to_string(delay_ms) + " " + std::to_string(loss));
  }
  void cut_link() { write_control("down"); }

  /// The arguments with which "nsenter" runs `program` on the other host.
  [[nodiscard]] std::vector<std::string> on_other_host(const std::string& program,
                                                       std::vector<std::string> arguments) {
    std::vector<std::string> all{"--target", std::to_string(other_.child().pid()), "--net", "--",
                                 program};
    all.insert(all.end(), arguments.begin(), arguments.end());
    return all;
  }

 private:
  [[nodiscard]] bool has_own_network() {
    const auto network_of = [](const std::string& process) {
      std::error_code none_yet;
      return std::filesystem::read_symlink("/proc/" + process + "/ns/net", none_yet);
    };
    const auto its = network_of(std::to_string(other_.child().pid()));
    return !its.empty() && its != network_of("self");
  }

  void write_control(const std::string& text) {
    folder_.write("control.new", text);
    std::filesystem::rename(folder_ / "control.new", folder_ / "control");
  }

  TempFolder folder_;
  RunningProgram other_;
  std::optional<RunningProgram> link_;
};

}  // namespace tsg::test
