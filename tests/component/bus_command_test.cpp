#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <future>
#include <thread>

#include "common/bus/command.hpp"
#include "tests/support/test_bus.hpp"
#include "tests/support/wait.hpp"

namespace tsg::test {
namespace {

using namespace std::chrono_literals;
using ::testing::HasSubstr;

BusConfig without_shared_memory() {
  BusConfig config;
  config.use_shared_memory = false;  // commands do not need it
  return config;
}

/// A service "slam" that answers on a thread of its own.
class RunningService {
 public:
  explicit RunningService(Bus& bus) : server_(bus, "slam") {
    server_.on("echo", [this](const std::string& argument) -> Expected<std::string> {
      ++calls_;
      return argument;
    });
    server_.on("fail", [](const std::string&) -> Expected<std::string> {
      return make_error(ExitCode::kCannotWrite, "the disk is full");
    });
    server_.on_lasting("ponder", [this](const std::string& argument) {
      ++calls_;
      return Expected<CommandServer::Pending>(
          [this, argument]() -> std::optional<Expected<std::string>> {
            if (!is_done_) return std::nullopt;
            return argument;
          });
    });
    server_.on_lasting("refuse", [](const std::string&) -> Expected<CommandServer::Pending> {
      return make_error(ExitCode::kUsage, "not now");
    });
    thread_ = std::jthread([this](const std::stop_token& stop) {
      while (!stop.stop_requested()) {
        server_.serve_pending();
        std::this_thread::sleep_for(2ms);
      }
    });
  }

  [[nodiscard]] int calls() const { return calls_; }
  void finish_pondering() { is_done_ = true; }

 private:
  std::atomic<int> calls_ = 0;
  std::atomic<bool> is_done_ = false;
  CommandServer server_;
  std::jthread thread_;  // last: stops first
};

class Commands : public ::testing::Test {
 protected:
  TestBus bus_{without_shared_memory()};
  CommandClient client_{bus_.bus()};
};

TEST_F(Commands, AreAnsweredWithWhatTheHandlerReturns) {
  const RunningService service(bus_.bus());
  const auto reply = client_.call("slam", "echo", R"({"folder":"/x"})", 5s);
  ASSERT_TRUE(reply) << reply.error().message;
  EXPECT_EQ(*reply, R"({"folder":"/x"})");
}

TEST_F(Commands, CarryAnErrorWithItsExitCode) {
  const RunningService service(bus_.bus());
  const auto reply = client_.call("slam", "fail", "{}", 5s);
  ASSERT_FALSE(reply);
  EXPECT_EQ(reply.error().code, ExitCode::kCannotWrite);
  EXPECT_EQ(reply.error().message, "the disk is full");
}

TEST_F(Commands, UnknownVerbsAreAnsweredWithTheKnownOnes) {
  const RunningService service(bus_.bus());
  const auto reply = client_.call("slam", "dance", "{}", 5s);
  ASSERT_FALSE(reply);
  EXPECT_EQ(reply.error().code, ExitCode::kUsage);
  EXPECT_THAT(reply.error().message, HasSubstr("dance"));
  EXPECT_THAT(reply.error().message, HasSubstr("echo"));
}

TEST_F(Commands, ArgumentsThatAreNoJsonObjectAreRefused) {
  const RunningService service(bus_.bus());
  for (const std::string argument : {"", "{", "[1]", "folder"}) {
    const auto reply = client_.call("slam", "echo", argument, 5s);
    ASSERT_FALSE(reply);
    EXPECT_EQ(reply.error().code, ExitCode::kUsage);
  }
  EXPECT_EQ(service.calls(), 0);
}

TEST_F(Commands, ToAServiceThatIsAbsentTimeOut) {
  const RunningService other(bus_.bus());
  const auto reply = client_.call("map_server", "save_map", "{}", 300ms);
  ASSERT_FALSE(reply);
  EXPECT_EQ(reply.error().code, ExitCode::kTimeout);
  EXPECT_THAT(reply.error().message, HasSubstr("map_server"));
}

TEST_F(Commands, ReachAServiceThatStartsLater) {
  auto reply = std::async(std::launch::async,
                          [this] { return client_.call("slam", "echo", R"({"n":1})", 10s); });
  std::this_thread::sleep_for(400ms);
  const RunningService service(bus_.bus());
  ASSERT_TRUE(reply.get());
}

TEST_F(Commands, ThatArriveTwiceAreCarriedOutOnceAndAnsweredTwice) {
  const RunningService service(bus_.bus());
  auto& replies = bus_.subscriber<topics::Reply>();
  ASSERT_TRUE(replies.wait_for_publishers(1, 5s));
  const auto fill = [](tsg_Command& command) {
    command.id = 4711;
    command.service = const_cast<char*>("slam");
    command.verb = const_cast<char*>("echo");
    command.argument = const_cast<char*>("{}");
  };
  const auto is_answer = [](const tsg_Reply& reply) { return reply.id == 4711; };
  ASSERT_TRUE(bus_.publish<topics::Command>(fill));
  ASSERT_TRUE(bus_.wait_for<topics::Reply>(5s, is_answer));
  ASSERT_TRUE(bus_.publish<topics::Command>(fill));
  ASSERT_TRUE(bus_.wait_for<topics::Reply>(5s, is_answer));
  EXPECT_EQ(service.calls(), 1);
}

TEST_F(Commands, ThatLastHoldUpNoOthersAndAreBegunOnce) {
  RunningService service(bus_.bus());
  CommandClient other(bus_.bus());
  auto slow = std::async(std::launch::async,
                         [&] { return other.call("slam", "ponder", R"({"of":"life"})", 20s); });
  ASSERT_TRUE(eventually(5s, [&] { return service.calls() == 1; }));
  ASSERT_TRUE(client_.call("slam", "echo", "{}", 5s));
  std::this_thread::sleep_for(600ms);  // the client repeats itself meanwhile
  EXPECT_EQ(service.calls(), 2) << "the one that lasts, and the echo";
  service.finish_pondering();
  const auto reply = slow.get();
  ASSERT_TRUE(reply) << reply.error().message;
  EXPECT_EQ(*reply, R"({"of":"life"})");
}

TEST_F(Commands, ThatLastMayBeRefusedAtOnce) {
  const RunningService service(bus_.bus());
  const auto reply = client_.call("slam", "refuse", "{}", 5s);
  ASSERT_FALSE(reply);
  EXPECT_EQ(reply.error().message, "not now");
}

TEST_F(Commands, WaitNoLongerOnceStopped) {
  std::stop_source stop;
  auto reply = std::async(std::launch::async, [&] {
    return client_.call("slam", "echo", "{}", std::chrono::hours(1), stop.get_token());
  });
  std::this_thread::sleep_for(50ms);
  stop.request_stop();
  ASSERT_EQ(reply.wait_for(5s), std::future_status::ready);
  EXPECT_FALSE(reply.get());
}

}  // namespace
}  // namespace tsg::test
