#include "services/tsgctl/doctor/multicast_check.hpp"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <string>
#include <system_error>

namespace tsg {
namespace {

/// Of the block for local use; not the group of DDS, so that no participant is disturbed.
constexpr const char* kGroup = "239.255.77.77";
constexpr int kTimeoutMs = 500;

/// A UDP socket that goes with its scope.
class UdpSocket {
 public:
  UdpSocket() : fd_(socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0)) {}
  ~UdpSocket() {
    if (fd_ >= 0) close(fd_);
  }
  UdpSocket(const UdpSocket&) = delete;
  UdpSocket& operator=(const UdpSocket&) = delete;
  UdpSocket(UdpSocket&&) = delete;
  UdpSocket& operator=(UdpSocket&&) = delete;

  [[nodiscard]] int fd() const { return fd_; }

 private:
  int fd_;
};

sockaddr_in address_of(const char* ip, in_port_t port) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = port;
  inet_pton(AF_INET, ip, &address.sin_addr);
  return address;
}

/// Joins the group on loopback and binds to a free port; 0 or errno.
int listen_to_group(const UdpSocket& receiver, sockaddr_in& group) {
  ip_mreqn membership{};
  inet_pton(AF_INET, kGroup, &membership.imr_multiaddr);
  inet_pton(AF_INET, "127.0.0.1", &membership.imr_address);
  socklen_t length = sizeof(group);
  // NOLINTBEGIN(cppcoreguidelines-pro-type-reinterpret-cast): the socket API's own idiom
  const bool joined =
      bind(receiver.fd(), reinterpret_cast<const sockaddr*>(&group), sizeof(group)) == 0 &&
      getsockname(receiver.fd(), reinterpret_cast<sockaddr*>(&group), &length) == 0 &&
      setsockopt(receiver.fd(), IPPROTO_IP, IP_ADD_MEMBERSHIP, &membership, sizeof(membership)) ==
          0;
  // NOLINTEND(cppcoreguidelines-pro-type-reinterpret-cast)
  return joined ? 0 : errno;
}

int send_to_group(const UdpSocket& sender, const sockaddr_in& group) {
  const sockaddr_in loopback = address_of("127.0.0.1", 0);
  constexpr std::array<char, 3> kMessage{'t', 's', 'g'};
  // NOLINTBEGIN(cppcoreguidelines-pro-type-reinterpret-cast): the socket API's own idiom
  const bool sent = setsockopt(sender.fd(), IPPROTO_IP, IP_MULTICAST_IF, &loopback.sin_addr,
                               sizeof(loopback.sin_addr)) == 0 &&
                    sendto(sender.fd(), kMessage.data(), kMessage.size(), 0,
                           reinterpret_cast<const sockaddr*>(&group), sizeof(group)) > 0;
  // NOLINTEND(cppcoreguidelines-pro-type-reinterpret-cast)
  return sent ? 0 : errno;
}

CheckResult no_multicast(const std::string& why) {
  return failed("multicast", "does not work on lo: " + why,
                "ip link set lo up; ip link set lo multicast on; let no firewall block 239.0.0.0/8 "
                "on lo");
}

}  // namespace

CheckResult check_multicast() {
  const UdpSocket receiver;
  const UdpSocket sender;
  sockaddr_in group = address_of(kGroup, 0);
  for (const int error : {listen_to_group(receiver, group), send_to_group(sender, group)}) {
    if (error != 0) return no_multicast(std::generic_category().message(error));
  }
  pollfd readable{.fd = receiver.fd(), .events = POLLIN, .revents = 0};
  if (poll(&readable, 1, kTimeoutMs) != 1) return no_multicast("what is sent does not come back");
  return passed("multicast", "works on lo");
}

}  // namespace tsg
