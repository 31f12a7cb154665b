#pragma once

// One 1.5 MB image with depth (VGA) handed from a process to another, and how long it took.

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

extern "C" {
#include "vga_frame.h"
}

#include "common/app/child_process.hpp"
#include "common/bus/bus.hpp"
#include "common/bus/topics.hpp"

namespace tsg {

template <>
inline const dds_topic_descriptor_t& descriptor<tsg_bench_VgaFrame>() {
  return tsg_bench_VgaFrame_desc;
}

namespace bench {

inline constexpr std::size_t kPixels = std::size_t{640} * 480;

/// The wire type that the services use: VGA images in the first part of larger arrays.
using ServiceFrame = topics::Rgbd;

/// The same images in a wire type without spare capacity.
struct VgaFrame {
  using Message = tsg_bench_VgaFrame;
  static constexpr const char* kName = "bench/vga";
  static constexpr Qos kQos{.domain = Domain::kSharedMemory, .keep_last = 4};
};

enum class Way { kZeroCopy, kSharedMemoryThenCopy, kUdp };

[[nodiscard]] BusConfig bus_config(Way way);

/// What the reading process says of one sample.
struct Receipt {
  std::uint64_t seq = 0;
  std::int64_t latency_ns = 0;     ///< publish() called, to the images being at the reader's hands
  bool in_shared_segment = false;  ///< the images read lie in RouDi's segment: nothing was copied
  bool is_intact = false;
};

/// The reading side, which is this program again; writes a Receipt of each sample to `fifo`.
[[nodiscard]] int run_reader(const std::string& topic, Way way, const std::string& fifo);

/// The reading process as the writer sees it.
class ReaderProcess {
 public:
  ReaderProcess(const std::string& topic, Way way);
  ~ReaderProcess();
  ReaderProcess(const ReaderProcess&) = delete;
  ReaderProcess& operator=(const ReaderProcess&) = delete;
  ReaderProcess(ReaderProcess&&) = delete;
  ReaderProcess& operator=(ReaderProcess&&) = delete;

  /// The receipt of the sample just published; nothing where it is lost.
  [[nodiscard]] std::optional<Receipt> wait_for_receipt() const;

 private:
  std::filesystem::path fifo_;
  std::optional<ChildProcess> process_;
  int fd_ = -1;
};

}  // namespace bench
}  // namespace tsg
