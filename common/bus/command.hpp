#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <random>
#include <stop_token>
#include <string>
#include <vector>

#include "common/bus/bus.hpp"
#include "common/bus/topics.hpp"
#include "common/core/error.hpp"

namespace tsg {

/// Answers the commands given to one service, on the thread that calls serve_pending().
///   CommandServer server(bus, "slam");
///   server.on("save_trajectory", [&](const std::string& argument) -> Expected<std::string> {...});
/// Every command gets its reply: an unknown verb and an argument that is no JSON object, too. A
/// command that arrives again is answered again, not carried out again.
class CommandServer {
 public:
  /// Gets a JSON object, returns one. Must not throw.
  using Handler = std::function<Expected<std::string>(const std::string& argument_json)>;

  /// Work that was begun and goes on elsewhere: its result once there is one. Must not throw.
  using Pending = std::function<std::optional<Expected<std::string>>()>;
  /// Begins such work, or says why not.
  using Beginner = std::function<Expected<Pending>(const std::string& argument_json)>;

  CommandServer(Bus& bus, std::string service);

  void on(const std::string& verb, Handler handler);
  /// For what takes longer than the serving thread may pause: `begin` starts it, and every
  /// serve_pending() asks whether it is done, until the command can be answered.
  void on_lasting(const std::string& verb, Beginner begin);

  /// Carries out what has come in since the last call and answers what is done; does not wait.
  void serve_pending();

 private:
  struct Answer {
    std::uint64_t id = 0;
    Expected<std::string> result;
  };

  /// A command that is not answered yet.
  struct Work {
    std::uint64_t id = 0;
    Pending pending;
  };

  void serve(const tsg_Command& command);
  [[nodiscard]] Expected<Pending> begin(const tsg_Command& command) const;
  void answer_what_is_done();
  void reply(const Answer& answer);

  std::string service_;
  std::map<std::string, Beginner> handlers_;
  std::vector<Work> works_;
  std::deque<Answer> answered_;  // the last ones, for commands that arrive again
  Subscriber<topics::Command> commands_;
  Publisher<topics::Reply> replies_;
};

/// Gives commands to services. One thread at a time.
class CommandClient {
 public:
  explicit CommandClient(Bus& bus);

  /// Waits for the answer: the reply of the verb, or its error with the exit code that a tool
  /// should end with; kTimeout where none comes. `argument_json` and the reply are JSON objects.
  [[nodiscard]] Expected<std::string> call(const std::string& service,
                                           const std::string& verb,
                                           const std::string& argument_json,
                                           std::chrono::milliseconds timeout,
                                           const std::stop_token& stop = {});

 private:
  /// The answer to command `id` if it comes in time.
  std::optional<Expected<std::string>> wait_for_reply(std::uint64_t id,
                                                      std::chrono::milliseconds timeout,
                                                      const std::stop_token& stop);

  Publisher<topics::Command> commands_;
  Subscriber<topics::Reply> replies_;
  std::mt19937_64 ids_{std::random_device{}()};  // unique among all clients of the bus
};

}  // namespace tsg
