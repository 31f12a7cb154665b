#pragma once

#include <chrono>
#include <string>

namespace tsg {

/// Where one child says READY=1 (the protocol of sd_notify): a datagram socket in the abstract
/// namespace, so that no file is left behind. Not thread-safe: one owner.
class NotifySocket {
 public:
  /// `name` makes the address unique within this process. Throws FatalError where it cannot be
  /// made.
  explicit NotifySocket(const std::string& name);
  ~NotifySocket();
  NotifySocket(NotifySocket&& other) noexcept;
  NotifySocket& operator=(NotifySocket&&) = delete;
  NotifySocket(const NotifySocket&) = delete;
  NotifySocket& operator=(const NotifySocket&) = delete;

  /// The value of NOTIFY_SOCKET for the child.
  [[nodiscard]] const std::string& address() const { return address_; }

  /// Whether READY=1 has come, waiting for it up to `timeout`.
  bool wait_ready(std::chrono::milliseconds timeout);

 private:
  void read_messages();

  std::string address_;
  int fd_ = -1;
  bool ready_ = false;
};

}  // namespace tsg
