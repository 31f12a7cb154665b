#include "services/tsgctl/run/notify_socket.hpp"

#include <poll.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstddef>
#include <system_error>
#include <utility>

#include "common/core/error.hpp"

namespace tsg {

NotifySocket::NotifySocket(const std::string& name)
    : address_("@tsgctl/" + std::to_string(getpid()) + "/" + name),
      fd_(socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0)) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  // An abstract name begins with a zero byte, which sd_notify writes as "@".
  address_.copy(address.sun_path, sizeof(address.sun_path));
  address.sun_path[0] = '\0';
  const auto length = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + address_.size());
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-reinterpret-cast): the socket API's own idiom
  if (fd_ >= 0 && bind(fd_, reinterpret_cast<const sockaddr*>(&address), length) == 0) return;
  const int error = errno;
  if (fd_ >= 0) close(fd_);
  throw FatalError(ExitCode::kFailure,
                   "cannot listen on " + address_ + ": " + std::generic_category().message(error));
}

NotifySocket::NotifySocket(NotifySocket&& other) noexcept
    : address_(std::move(other.address_)),
      fd_(std::exchange(other.fd_, -1)),
      ready_(other.ready_) {}

NotifySocket::~NotifySocket() {
  if (fd_ >= 0) close(fd_);
}

bool NotifySocket::wait_ready(std::chrono::milliseconds timeout) {
  if (ready_) return true;
  pollfd readable{.fd = fd_, .events = POLLIN, .revents = 0};
  poll(&readable, 1, static_cast<int>(timeout.count()));
  read_messages();
  return ready_;
}

void NotifySocket::read_messages() {
  std::array<char, 4096> buffer{};
  for (;;) {
    const ssize_t length = recv(fd_, buffer.data(), buffer.size(), 0);
    if (length <= 0) return;
    // A message is lines of NAME=value; READY may stand at any place among them.
    const std::string message = "\n" + std::string(buffer.data(), static_cast<std::size_t>(length));
    if ((message + "\n").find("\nREADY=1\n") != std::string::npos) ready_ = true;
  }
}

}  // namespace tsg
