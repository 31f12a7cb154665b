#pragma once

#include <filesystem>
#include <optional>
#include <stop_token>

#include "common/app/child_process.hpp"

namespace tsg {

/// RouDi for the time of a run: the one that runs already, which is left alone, or one of ours,
/// which is stopped again. Make it before and destroy it after whatever uses shared memory.
class RoudiProcess {
 public:
  /// Starts RouDi where none answers and waits until it does. Throws FatalError (kUnavailable,
  /// kTimeout) with the way to repair it. On stop it may return before RouDi answers.
  RoudiProcess(const std::filesystem::path& log_file, const std::stop_token& stop);
  ~RoudiProcess();
  RoudiProcess(const RoudiProcess&) = delete;
  RoudiProcess& operator=(const RoudiProcess&) = delete;
  RoudiProcess(RoudiProcess&&) = delete;
  RoudiProcess& operator=(RoudiProcess&&) = delete;

  [[nodiscard]] bool is_ours() const { return child_.has_value(); }

 private:
  void wait_until_it_answers(const std::filesystem::path& log_file, const std::stop_token& stop);

  std::optional<ChildProcess> child_;
};

}  // namespace tsg
