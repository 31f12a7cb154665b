#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <random>
#include <stop_token>
#include <string>

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

  CommandServer(Bus& bus, std::string service);

  void on(const std::string& verb, Handler handler);

  /// Carries out what has come in since the last call; does not wait.
  void serve_pending();

 private:
  struct Answer {
    std::uint64_t id = 0;
    Expected<std::string> result;
  };

  void serve(const tsg_Command& command);
  [[nodiscard]] Expected<std::string> carry_out(const tsg_Command& command) const;
  void reply(const Answer& answer);

  std::string service_;
  std::map<std::string, Handler> handlers_;
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
