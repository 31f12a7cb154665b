#include "services/tsgctl/run/run_session.hpp"

#include <csignal>
#include <future>

#include "common/app/config_file.hpp"
#include "common/app/shipped_files.hpp"
#include "common/bus/bus_config_file.hpp"
#include "common/core/time.hpp"
#include "services/tsgctl/run/accuracy.hpp"

namespace tsg {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr seconds kReadyTimeout{60};   // a network may take long to load
constexpr seconds kAnswerTimeout{60};  // the map of a long sequence takes its time
constexpr seconds kDrainTimeout{30};
constexpr milliseconds kDiscoveryTime{500};
constexpr milliseconds kWatchPeriod{50};
/// The camera stays a moment after its last frames; those before have nothing final to tell.
constexpr std::uint64_t kLastFrames = 15;
/// Nothing for so long after the camera's end: slam has answered all it will.
constexpr milliseconds kQuiet{500};
// Ctrl-C to the last process gone in 2 s: these and RouDi's 500 ms together stay below.
constexpr milliseconds kLastWordsTimeout{400};
constexpr milliseconds kQuickStop{700};
constexpr milliseconds kNormalStop{3000};

BusConfig bus_config_of(const RunOptions& options) {
  return load_bus_config(options.config.empty()
                             ? ConfigFile::from_overrides(options.overrides)
                             : ConfigFile::load(options.config, options.overrides));
}

/// Stops a waiting thread when its scope ends, however it ends.
class StopAtEnd {
 public:
  explicit StopAtEnd(std::stop_source& source) : source_(source) {}
  ~StopAtEnd() { source_.request_stop(); }
  StopAtEnd(const StopAtEnd&) = delete;
  StopAtEnd& operator=(const StopAtEnd&) = delete;
  StopAtEnd(StopAtEnd&&) = delete;
  StopAtEnd& operator=(StopAtEnd&&) = delete;

 private:
  std::stop_source& source_;
};

}  // namespace

RunSession::RunSession(const RunOptions& options,
                       const Sequence& sequence,
                       const StopOnSignal& signals)
    : options_(options),
      sequence_(sequence),
      signals_(signals),
      out_(options.out),
      supervisor_(out_.logs()) {}

RunOutcome RunSession::run() {
  std::optional<FatalError> failure;
  try {
    start();
    follow_camera();
    follow_stragglers();
    progress_.finish(progress_state());
    save();
  } catch (const FatalError& error) {
    failure = error;
    save_what_is_there();
  }
  stop(failure ? kQuickStop : kNormalStop);
  return {make_report(failure), failure};
}

void RunSession::start() {
  const RunPlan plan = value_or_throw(make_run_plan(options_, program_folder()));
  join_bus();
  for (const ProcessPlan& process : plan.processes) {
    if (&process != &plan.camera()) supervisor_.start(process);
  }
  for (const ProcessPlan& process : plan.processes) {
    if (&process == &plan.camera()) break;
    progress_.say("waiting for " + process.service);
    supervisor_.wait_ready(process.service, kReadyTimeout, signals_.token());
    throw_if_stopped();
  }
  supervisor_.start(plan.camera());
}

void RunSession::join_bus() {
  BusConfig config = bus_config_of(options_);
  if (config.use_shared_memory) {
    progress_.say("waiting for RouDi");
    roudi_ = std::make_unique<RoudiProcess>(out_.logs() / "roudi.log", signals_.token());
    throw_if_stopped();
  }
  // tsgctl itself stays off shared memory: it follows small messages only, and RouDi, when it is
  // stopped at the end, would wait for every process that is registered with it.
  config.use_shared_memory = false;
  bus_ = std::make_unique<Bus>(config);
  watch_ = std::make_unique<TrackingWatch>(*bus_);
  commands_ = std::make_unique<CommandClient>(*bus_);
  const bool may_have_company = roudi_ == nullptr || !roudi_->is_ours();
  if (may_have_company && watch_->sees_other_system(kDiscoveryTime, signals_.token())) {
    throw FatalError(ExitCode::kUnavailable,
                     "another TSG-SLAM runs on this bus (tsgctl status shows it); stop it first, "
                     "or use other domains: --set bus.standard_domain=1 --set "
                     "bus.shared_memory_domain=11");
  }
}

void RunSession::follow_camera() {
  while (!supervisor_.has_finished("camera")) {
    throw_if_stopped();
    supervisor_.check_alive("camera");
    const bool heard = watch_->wait(kWatchPeriod, signals_.token());
    progress_.update(progress_state());
    if (!heard) ask_camera_at_its_end();
  }
}

void RunSession::ask_camera_at_its_end() {
  const std::uint64_t passed = watch_->frames_passed();
  if (passed + kLastFrames < sequence_.frames || passed == camera_asked_at_) return;
  camera_asked_at_ = passed;
  // It may end meanwhile: then what it said before holds.
  const auto reply = commands_->call("camera", "report", "{}", kLastWordsTimeout);
  if (!reply) return;
  auto report = nlohmann::json::parse(*reply, nullptr, /*allow_exceptions=*/false);
  if (report.is_object()) replies_["camera"]["report"] = std::move(report);
}

void RunSession::follow_stragglers() {
  const auto deadline = std::chrono::steady_clock::now() + kDrainTimeout;
  auto quiet_since = std::chrono::steady_clock::now();
  while (watch_->frames_passed() < sequence_.frames) {
    throw_if_stopped();
    supervisor_.check_alive("camera");
    const bool heard = watch_->wait(kWatchPeriod, signals_.token());
    const auto now = std::chrono::steady_clock::now();
    if (heard) quiet_since = now;
    if (now - quiet_since > kQuiet || now > deadline) return;
  }
}

void RunSession::save() {
  progress_.say("saving trajectory and map");
  const std::string folder = std::filesystem::absolute(out_.path()).string();
  replies_["slam"] = ask("slam", "save_trajectory", {{"folder", folder}});
  const auto keyframes = replies_["slam"].value("keyframes_sent", std::uint64_t{0});
  replies_["map_server"] =
      ask("map_server", "save_map", {{"folder", folder}, {"keyframes", keyframes}});
  if (!options_.save_map.empty()) {
    const std::string file = std::filesystem::absolute(options_.save_map).string();
    replies_["slam"]["saved_map"] = ask("slam", "save_map", {{"file", file}});
  }
  for (const std::string service : {"slam", "segmentation", "map_server"}) {
    if (!supervisor_.is_running(service)) continue;
    replies_[service]["report"] = ask(service, "report", nlohmann::json::object());
  }
}

void RunSession::save_what_is_there() {
  if (commands_ == nullptr || watch_->log().size() == 0) return;
  if (!supervisor_.is_running("slam")) return;
  const std::string folder = std::filesystem::absolute(out_.path()).string();
  const nlohmann::json argument = {{"folder", folder}};
  // Its failure is not worth a word beside the one that led here.
  (void)commands_->call("slam", "save_trajectory", argument.dump(), kLastWordsTimeout);
}

nlohmann::json RunSession::ask(const std::string& service,
                               const std::string& verb,
                               const nlohmann::json& argument) {
  std::stop_source give_up;
  auto answer = std::async(std::launch::async, [&, token = give_up.get_token()] {
    return commands_->call(service, verb, argument.dump(), kAnswerTimeout, token);
  });
  const StopAtEnd stop_at_end(give_up);  // before `answer` waits for its thread
  while (answer.wait_for(kWatchPeriod) != std::future_status::ready) {
    throw_if_stopped();
    supervisor_.check_alive("camera");
  }
  const std::string reply = value_or_throw(answer.get());
  auto json = nlohmann::json::parse(reply, nullptr, /*allow_exceptions=*/false);
  if (json.is_object()) return json;
  throw FatalError(ExitCode::kBadData, service + " answered " + verb +
                                           " with something that is no JSON object: " + reply);
}

void RunSession::stop(milliseconds budget) {
  supervisor_.stop_all("camera", budget);
  roudi_.reset();
}

void RunSession::throw_if_stopped() const {
  if (signals_.signal() == SIGTERM) {
    throw FatalError(ExitCode::kTerminated, "stopped by SIGTERM before the run was done");
  }
  if (signals_.token().stop_requested()) {
    throw FatalError(ExitCode::kInterrupted, "stopped by Ctrl-C before the run was done");
  }
}

ProgressState RunSession::progress_state() const {
  return {watch_->frames_passed(), sequence_.frames, watch_->state(), watch_->elapsed_s()};
}

RunReport RunSession::make_report(const std::optional<FatalError>& failure) {
  RunReport report;
  report.version = TSG_VERSION;
  report.input = std::filesystem::absolute(options_.input).lexically_normal().string();
  report.out = options_.out.string();
  report.pace = to_string(options_.pace);
  report.segmentation = to_string(options_.segmentation);
  report.model = options_.model.string();
  report.problem = failure ? failure->what() : "";
  report.frames_total = sequence_.frames;
  if (watch_ != nullptr) {
    report.duration_s = watch_->elapsed_s();
    report.tracking = watch_->log().totals();
  }
  if (sequence_.ground_truth) {
    const auto& truth = *sequence_.ground_truth;
    report.accuracy = measure_accuracy(truth, out_.path() / "trajectory.txt");
    report.accuracy_live = measure_accuracy(truth, out_.path() / "trajectory_live.txt");
  }
  if (const auto reply = replies_.find("map_server"); reply != replies_.end()) {
    report.objects = objects_of(*reply);
  }
  if (const auto reply = replies_.find("camera"); reply != replies_.end()) {
    report.frames_late = (*reply)["report"].value("frames_late", std::uint64_t{0});
  }
  report.processes = supervisor_.uses();
  report.files = out_.files();
  report.services = replies_;
  return report;
}

}  // namespace tsg
