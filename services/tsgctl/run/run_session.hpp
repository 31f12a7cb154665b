#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "common/app/stop_on_signal.hpp"
#include "common/bus/bus.hpp"
#include "common/bus/command.hpp"
#include "services/tsgctl/lib/run_plan.hpp"
#include "services/tsgctl/lib/run_report.hpp"
#include "services/tsgctl/run/output_folder.hpp"
#include "services/tsgctl/run/progress.hpp"
#include "services/tsgctl/run/roudi_process.hpp"
#include "services/tsgctl/run/sequence.hpp"
#include "services/tsgctl/run/supervisor.hpp"
#include "services/tsgctl/run/tracking_watch.hpp"

namespace tsg {

/// What came of a run; `failure` is set where it did not complete, and the report tells how far it
/// came.
struct RunOutcome {
  RunReport report;
  std::optional<FatalError> failure;
};

/// One run from the start of RouDi to the end of the last process. Use once, on the main thread.
class RunSession {
 public:
  RunSession(const RunOptions& options, const Sequence& sequence, const StopOnSignal& signals);

  [[nodiscard]] RunOutcome run();

 private:
  void start();
  void join_bus();
  void follow_camera();
  /// What only the camera knows, while it is still there.
  void ask_camera_at_its_end();
  void follow_stragglers();
  void save();
  /// After a failure or Ctrl-C: the trajectory so far, if slam still answers.
  void save_what_is_there();
  void stop(std::chrono::milliseconds budget);
  /// The reply of a service, while all others are watched.
  nlohmann::json ask(const std::string& service,
                     const std::string& verb,
                     const nlohmann::json& argument);
  void throw_if_stopped() const;
  [[nodiscard]] ProgressState progress_state() const;
  [[nodiscard]] RunReport make_report(const std::optional<FatalError>& failure);

  const RunOptions& options_;
  const Sequence& sequence_;
  const StopOnSignal& signals_;
  OutputFolder out_;
  Progress progress_;
  nlohmann::json replies_ = nlohmann::json::object();
  std::uint64_t camera_asked_at_ = 0;  // frames that had passed then
  std::unique_ptr<RoudiProcess> roudi_;
  std::unique_ptr<Bus> bus_;
  std::unique_ptr<TrackingWatch> watch_;
  std::unique_ptr<CommandClient> commands_;
  Supervisor supervisor_;
};

}  // namespace tsg
