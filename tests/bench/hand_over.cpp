#include "tests/bench/hand_over.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include "common/core/time.hpp"
#include "tests/support/memory_map.hpp"

namespace tsg::bench {
namespace {

using namespace std::chrono_literals;

// Not the services' numbers, and one for each transport: a process has one configuration a domain.
constexpr int kSharedMemoryDomain = 10;
constexpr int kUdpDomain = 20;

template <typename Message>
bool is_intact(const Message& message) {
  const auto expected = static_cast<std::uint8_t>(message.header.seq);
  return message.colour[0] == expected && message.colour[3 * kPixels - 1] == expected &&
         message.depth[kPixels - 1] == expected;
}

/// Looks at the sample where the reader would work on it.
template <typename Message>
Receipt inspect(const Message& message) {
  Receipt receipt{.seq = message.header.seq, .is_intact = is_intact(message)};
  receipt.latency_ns = monotonic_ns() - message.header.publish_monotonic_ns;
  // The last byte as well: a copy of a part would not do.
  receipt.in_shared_segment = test::is_in_shared_segment(&message) &&
                              test::is_in_shared_segment(&message.depth[kPixels - 1]);
  return receipt;
}

template <typename Topic>
int read_samples(Way way, int fifo) {
  Bus bus(bus_config(way));
  Subscriber<Topic> subscriber(bus);
  while (const auto sample = subscriber.take({}, 10s)) {
    Receipt receipt;
    if (way == Way::kSharedMemoryThenCopy) {
      // What a plain dds_take() does: a new piece of the heap, and the whole sample into it.
      const auto copy = std::make_unique_for_overwrite<typename Topic::Message>();
      *copy = **sample;
      receipt = inspect(*copy);
    } else {
      receipt = inspect(**sample);
    }
    if (::write(fifo, &receipt, sizeof(receipt)) != sizeof(receipt)) return 0;  // writer is done
  }
  return 0;
}

}  // namespace

BusConfig bus_config(Way way) {
  BusConfig config;
  config.use_shared_memory = way != Way::kUdp;
  config.shared_memory_domain = way == Way::kUdp ? kUdpDomain : kSharedMemoryDomain;
  return config;
}

int run_reader(const std::string& topic, Way way, const std::string& fifo) {
  const int fd = ::open(fifo.c_str(), O_WRONLY | O_CLOEXEC);
  if (fd < 0) return 1;
  const int result = topic == VgaFrame::kName ? read_samples<VgaFrame>(way, fd)
                                              : read_samples<ServiceFrame>(way, fd);
  ::close(fd);
  return result;
}

ReaderProcess::ReaderProcess(const std::string& topic, Way way)
    : fifo_(std::filesystem::temp_directory_path() / ("bench_bus." + std::to_string(::getpid()))) {
  std::filesystem::remove(fifo_);
  if (::mkfifo(fifo_.c_str(), 0600) != 0) {
    throw FatalError(ExitCode::kCannotWrite, fifo_.string() + ": cannot make a FIFO");
  }
  process_ = value_or_throw(ChildProcess::spawn(
      {.program = std::filesystem::read_symlink("/proc/self/exe").string(),
       .arguments = {"--reader", topic, std::to_string(static_cast<int>(way)), fifo_.string()}}));
  fd_ = ::open(fifo_.c_str(), O_RDONLY | O_CLOEXEC);  // waits for the reader to open it
}

ReaderProcess::~ReaderProcess() {
  ::close(fd_);
  std::filesystem::remove(fifo_);
}

std::optional<Receipt> ReaderProcess::wait_for_receipt() const {
  constexpr int kTimeoutMs = 2000;
  pollfd readable{.fd = fd_, .events = POLLIN, .revents = 0};
  Receipt receipt;
  if (::poll(&readable, 1, kTimeoutMs) != 1) return std::nullopt;
  if (::read(fd_, &receipt, sizeof(receipt)) != sizeof(receipt)) return std::nullopt;
  return receipt;
}

}  // namespace tsg::bench
