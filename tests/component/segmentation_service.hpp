#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>
#include <opencv2/core/types.hpp>
#include <optional>
#include <string>
#include <vector>

#include "common/bus/command.hpp"
#include "common/bus/convert.hpp"
#include "common/bus/diagnostics.hpp"
#include "common/core/time.hpp"
#include "tests/support/running_segmentation.hpp"
#include "tests/support/temp_folder.hpp"
#include "tests/support/test_bus.hpp"
#include "tests/support/wait.hpp"

namespace tsg::test {

using namespace std::chrono_literals;

/// The camera's and the masks' reader's side of tsg-segmentation.
class SegmentationService : public ::testing::Test {
 protected:
  static constexpr int kWidth = 64;
  static constexpr int kHeight = 48;

  /// Stamp of frame `seq`, at 10 Hz.
  static std::int64_t stamp_ns(std::uint64_t seq) {
    return 1'700'000'000'000'000'000 + static_cast<std::int64_t>(seq) * 100'000'000;
  }

  static std::vector<std::string> dataset(const TempFolder& folder) {
    return {"segmentation.provider=dataset",
            "segmentation.dataset.folder=" + folder.path().string()};
  }
  /// `network` is the content of an .onnx file.
  std::vector<std::string> model(const std::string& network) {
    return {"segmentation.provider=model", "segmentation.model.threads=1",
            "segmentation.model.file=" + folder_.write("tiny.onnx", network).string()};
  }

  /// Whether the service comes to listen for frames, and we for its masks.
  [[nodiscard]] bool is_working(const RunningSegmentation& service) {
    return bus_.watch<topics::Instances>(20s) &&
           eventually(20s, [&] { return service.output().find(" ready\n") != std::string::npos; });
  }
  /// Whether the service comes to say `text`.
  [[nodiscard]] static bool says(const RunningSegmentation& service, const std::string& text) {
    return eventually(10s, [&] { return service.output().find(text) != std::string::npos; });
  }

  /// A frame all of one grey.
  [[nodiscard]] bool send(std::uint64_t seq,
                          cv::Size size = {kWidth, kHeight},
                          std::uint8_t grey = 0) {
    return bus_.publish<topics::Rgbd>([&](tsg_RgbdFrame& message) {
      message.header = {seq, stamp_ns(seq), monotonic_ns()};
      message.intrinsics = {static_cast<std::uint32_t>(size.width),
                            static_cast<std::uint32_t>(size.height),
                            50.0,
                            50.0,
                            size.width / 2.0,
                            size.height / 2.0,
                            {}};
      message.depth_units_per_metre = 5000.0;
      std::memset(message.colour, grey, sizeof(message.colour));
    });
  }

  std::optional<Sample<topics::Instances>> mask_of(std::uint64_t seq) {
    return bus_.wait_for<topics::Instances>(
        10s, [&](const tsg_InstanceMask& mask) { return mask.header.seq == seq; });
  }

  /// Whether diagnostics come for which `is_wanted`; bus_.watch<topics::Diagnostics>() first.
  template <typename Predicate>
  [[nodiscard]] bool has_diagnostic(Predicate is_wanted) {
    return bus_
        .wait_for<topics::Diagnostics>(10s,
                                       [&](const topics::Diagnostics::Message& message) {
                                         const auto all = to_diagnostics(message);
                                         return all.at(0).name == "segmentation" &&
                                                is_wanted(all.at(0).diagnostic);
                                       })
        .has_value();
  }
  /// A value of a diagnostic; empty where there is none.
  static std::string value_of(const Diagnostic& diagnostic, const std::string& key) {
    for (const auto& [name, value] : diagnostic.values) {
      if (name == key) return value;
    }
    return {};
  }

  nlohmann::json report(const std::string& service = "segmentation") {
    CommandClient client(bus_.bus());
    const auto reply = client.call(service, "report", "{}", 5s);
    EXPECT_TRUE(reply.has_value()) << (reply ? "" : reply.error().message);
    return reply ? nlohmann::json::parse(*reply) : nlohmann::json();
  }

  TestBus bus_;
  TempFolder folder_;
};

}  // namespace tsg::test
