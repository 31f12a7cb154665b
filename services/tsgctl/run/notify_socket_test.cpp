#include "services/tsgctl/run/notify_socket.hpp"

#include <gtest/gtest.h>
#include <systemd/sd-daemon.h>

#include <cstdlib>

namespace tsg {
namespace {

using std::chrono::milliseconds;

/// What a child does; NOTIFY_SOCKET is unset again at once.
int notify(const NotifySocket& socket, const char* state) {
  setenv("NOTIFY_SOCKET", socket.address().c_str(), 1);
  return sd_notify(1, state);
}

TEST(NotifySocket, HearsReadyOfSdNotify) {
  NotifySocket socket("hears");
  EXPECT_FALSE(socket.wait_ready(milliseconds(0)));
  ASSERT_GT(notify(socket, "READY=1"), 0);
  EXPECT_TRUE(socket.wait_ready(milliseconds(1000)));
}

TEST(NotifySocket, OtherStatesAreNotReady) {
  NotifySocket socket("other");
  ASSERT_GT(notify(socket, "STATUS=READY=1 soon"), 0);
  ASSERT_GT(notify(socket, "WATCHDOG=1"), 0);
  EXPECT_FALSE(socket.wait_ready(milliseconds(10)));
}

TEST(NotifySocket, FindsReadyAmongOtherLines) {
  NotifySocket socket("among");
  ASSERT_GT(notify(socket, "STATUS=working\nREADY=1\nMAINPID=1"), 0);
  EXPECT_TRUE(socket.wait_ready(milliseconds(1000)));
}

TEST(NotifySocket, ReadyStays) {
  NotifySocket socket("stays");
  ASSERT_GT(notify(socket, "READY=1"), 0);
  EXPECT_TRUE(socket.wait_ready(milliseconds(1000)));
  EXPECT_TRUE(socket.wait_ready(milliseconds(0)));
}

}  // namespace
}  // namespace tsg
