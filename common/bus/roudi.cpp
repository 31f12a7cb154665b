#include "common/bus/roudi.hpp"

#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string>

namespace tsg {
namespace {

/// 0, or the errno of connecting to RouDi's socket.
int connect_to_roudi() {
  const int fd = ::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  if (fd < 0) return errno;
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  std::strncpy(address.sun_path, kRoudiSocket, sizeof(address.sun_path) - 1);
  // NOLINTNEXTLINE(*-reinterpret-cast): the socket API's own idiom
  const auto* any = reinterpret_cast<const sockaddr*>(&address);
  const int error = ::connect(fd, any, sizeof(address)) == 0 ? 0 : errno;
  ::close(fd);
  return error;
}

}  // namespace

Expected<void> check_roudi() {
  const int error = connect_to_roudi();
  if (error == 0) return {};
  const std::string socket = kRoudiSocket;
  if (error == EACCES) {
    return make_error(ExitCode::kUnavailable,
                      "RouDi runs as another user (no access to " + socket +
                          "); run this process as the user that RouDi runs as");
  }
  return make_error(ExitCode::kUnavailable,
                    "RouDi, the shared-memory daemon, is not running (" + socket + ": " +
                        std::strerror(error) +  // NOLINT(concurrency-mt-unsafe): at start-up
                        "); start it with 'iox-roudi -c config/roudi.toml' or 'systemctl start "
                        "iox-roudi', or set bus.use_shared_memory=false to do without");
}

}  // namespace tsg
