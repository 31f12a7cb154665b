#include "common/bus/command.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

namespace tsg {
namespace {

// A client repeats its command after this time, doubled each time: its first one may have been
// sent before the service had found it, or the reply before it had found the service's.
constexpr std::chrono::milliseconds kFirstRepeat{250};
constexpr std::size_t kAnswersKept = 32;

bool is_json_object(const std::string& text) {
  return nlohmann::json::parse(text, nullptr, /*allow_exceptions=*/false).is_object();
}

}  // namespace

CommandServer::CommandServer(Bus& bus, std::string service)
    : service_(std::move(service)), commands_(bus), replies_(bus) {}

void CommandServer::on(const std::string& verb, Handler handler) {
  handlers_[verb] = [handler = std::move(handler)](const std::string& argument) {
    // Done before it is asked for the first time.
    return Expected<Pending>([result = handler(argument)] { return std::optional(result); });
  };
}

void CommandServer::on_lasting(const std::string& verb, Beginner begin) {
  handlers_[verb] = std::move(begin);
}

void CommandServer::serve_pending() {
  while (const auto command = commands_.try_take()) {
    if (service_ == (*command)->service) serve(**command);
  }
  answer_what_is_done();
}

void CommandServer::serve(const tsg_Command& command) {
  const auto known = std::find_if(answered_.begin(), answered_.end(),
                                  [&](const Answer& answer) { return answer.id == command.id; });
  if (known != answered_.end()) {
    reply(*known);
    return;
  }
  const bool is_begun = std::any_of(works_.begin(), works_.end(),
                                    [&](const Work& work) { return work.id == command.id; });
  if (is_begun) return;
  auto pending = begin(command);
  works_.push_back({command.id, pending ? std::move(*pending) : [error = pending.error()] {
                      return std::optional<Expected<std::string>>(tl::unexpected(error));
                    }});
}

void CommandServer::answer_what_is_done() {
  std::erase_if(works_, [this](const Work& work) {
    auto result = work.pending();
    if (!result) return false;
    answered_.push_back({work.id, std::move(*result)});
    if (answered_.size() > kAnswersKept) answered_.pop_front();
    reply(answered_.back());
    return true;
  });
}

Expected<CommandServer::Pending> CommandServer::begin(const tsg_Command& command) const {
  const auto handler = handlers_.find(command.verb);
  if (handler == handlers_.end()) {
    std::string verbs;
    for (const auto& [verb, unused] : handlers_) verbs += " " + verb;
    return make_error(ExitCode::kUsage,
                      service_ + " knows no command '" + command.verb + "', only:" + verbs);
  }
  const std::string argument = command.argument;
  if (!is_json_object(argument)) {
    return make_error(ExitCode::kUsage, "the argument of " + service_ + " " + command.verb +
                                            " must be a JSON object, for example {}; it is '" +
                                            argument + "'");
  }
  return handler->second(argument);
}

void CommandServer::reply(const Answer& answer) {
  const bool ok = answer.result.has_value();
  const std::string& text = ok ? *answer.result : answer.result.error().message;
  tsg_Reply message{};
  message.id = answer.id;
  message.service = lend(service_);
  message.ok = ok;
  message.exit_code = static_cast<std::int32_t>(ok ? ExitCode::kOk : answer.result.error().code);
  message.text = lend(text);
  // A reply that could not be sent is sent again when the client repeats its command.
  static_cast<void>(replies_.publish(message));
}

CommandClient::CommandClient(Bus& bus) : commands_(bus), replies_(bus) {}

Expected<std::string> CommandClient::call(const std::string& service,
                                          const std::string& verb,
                                          const std::string& argument_json,
                                          std::chrono::milliseconds timeout,
                                          const std::stop_token& stop) {
  const auto deadline = Waiter::deadline_after(timeout);
  tsg_Command command{};
  command.id = ids_();
  command.service = lend(service);
  command.verb = lend(verb);
  command.argument = lend(argument_json);
  // What is sent before anybody listens is lost; the first repeat would make up for it, later.
  commands_.wait_for_subscribers(1, std::min(timeout, kFirstRepeat), stop);
  auto patience = kFirstRepeat;
  while (Waiter::Clock::now() < deadline && !stop.stop_requested()) {
    if (auto sent = commands_.publish(command); !sent) return tl::unexpected(sent.error());
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline - Waiter::Clock::now());
    if (auto reply = wait_for_reply(command.id, std::min(patience, left), stop)) return *reply;
    patience *= 2;
  }
  return make_error(ExitCode::kTimeout, service + " did not answer '" + verb + "' within " +
                                            std::to_string(timeout.count()) +
                                            " ms; is it running? ('tsgctl status' says so)");
}

std::optional<Expected<std::string>> CommandClient::wait_for_reply(
    std::uint64_t id, std::chrono::milliseconds timeout, const std::stop_token& stop) {
  const auto deadline = Waiter::deadline_after(timeout);
  while (Waiter::Clock::now() < deadline) {
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline - Waiter::Clock::now());
    const auto reply = replies_.take(stop, left);
    if (!reply) return std::nullopt;
    if ((*reply)->id != id) continue;
    if ((*reply)->ok) return Expected<std::string>((*reply)->text);
    const auto code = static_cast<ExitCode>((*reply)->exit_code);
    return Expected<std::string>(make_error(code, (*reply)->text));
  }
  return std::nullopt;
}

}  // namespace tsg
