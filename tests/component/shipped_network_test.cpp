// The network that is shipped, in rooms that are rendered here and now: shipped scenes, none of
// which it has learnt from.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <numeric>
#include <opencv2/core.hpp>
#include <span>

#include "common/app/shipped_files.hpp"
#include "common/scene_file/scene_file.hpp"
#include "common/simulation/simulator.hpp"
#include "services/segmentation/lib/model_provider.hpp"
#include "tests/support/run_program.hpp"

namespace tsg {
namespace {

using testing::IsSupersetOf;

/// What is smaller in a frame of VGA size counts neither way: 1/300 of it.
constexpr int kMinArea = 1024;

/// Best overlaps (IoU) of true instances with something found of their class, by class.
using Overlaps = std::map<std::string, std::vector<double>>;

double iou(const cv::Mat& a, const cv::Mat& b) {
  const int joined = cv::countNonZero(a | b);
  return joined > 0 ? static_cast<double>(cv::countNonZero(a & b)) / joined : 0.0;
}

double mean_of(std::span<const double> numbers) {
  return std::accumulate(numbers.begin(), numbers.end(), 0.0) /
         static_cast<double>(std::max<std::size_t>(1, numbers.size()));
}

double best_iou(const cv::Mat& truth,
                const std::string& class_name,
                const InstanceSegmentation& found) {
  double best = 0.0;
  for (std::size_t i = 0; i < found.instances.size(); ++i) {
    if (found.instances[i].class_name != class_name) continue;
    best = std::max(best, iou(truth, found.labels == static_cast<int>(i) + 1));
  }
  return best;
}

class ShippedNetwork : public testing::Test {
 protected:
  void SetUp() override {
    const auto file = value_or_throw(find_shipped_network()).string();
    provider_ = value_or_throw(ModelProvider::make({.model = {.file = file}, .decoder = {}}));
  }

  /// Adds the overlaps in some frames of a scene.
  void look_at(const std::string& scene_name, const std::vector<int>& frames) {
    const auto scene =
        value_or_throw(load_scene(TSG_SOURCE_DIR "/config/scenes/" + scene_name + ".yaml"));
    auto simulator = value_or_throw(simulation::Simulator::build(scene));
    cv::Mat labels(480, 640, CV_8UC1);
    for (const int index : frames) {
      const simulation::SimulatedFrame frame = simulator.render(index);
      const RgbdFrame seen{
          .seq = 0, .stamp_ns = 0, .camera = {}, .colour = frame.colour, .depth = {}};
      const auto found = value_or_throw(provider_->segment(seen, labels));
      for (const auto& instance : simulator.instances()) {
        const cv::Mat truth = frame.ids == instance.id;
        if (cv::countNonZero(truth) < kMinArea) continue;
        overlaps_[instance.class_name].push_back(
            best_iou(truth, instance.class_name, found.segmentation));
      }
    }
  }

  /// Mean over all instances, and over the best half of them: the others are small or mostly
  /// hidden.
  struct Overlap {
    double all = 0.0;
    double best_half = 0.0;
  };

  Overlap overlap_of(const std::string& class_name) {
    std::vector<double>& overlaps = overlaps_[class_name];
    std::ranges::sort(overlaps, std::greater<>());
    const std::span<const double> half(overlaps.data(), overlaps.size() / 2);
    const Overlap found{.all = mean_of(overlaps), .best_half = mean_of(half)};
    RecordProperty(class_name + "_instances", static_cast<int>(overlaps.size()));
    RecordProperty(class_name + "_iou", std::to_string(found.all));
    RecordProperty(class_name + "_iou_best_half", std::to_string(found.best_half));
    return found;
  }

  std::unique_ptr<ModelProvider> provider_;
  Overlaps overlaps_;
};

TEST_F(ShippedNetwork, IsUnderstoodAndNamesWhatSlamTakesForMovers) {
  const auto result = test::run_program(
      TSG_BIN_DIR "/tsgctl",
      {"model", "check", value_or_throw(find_shipped_network()).string(), "--json"});
  ASSERT_EQ(result.end.exit_code, 0) << result.output;
  const auto told = nlohmann::json::parse(result.output);
  EXPECT_EQ(told["layout"], "SOLOv2, 11 raw outputs");
  EXPECT_EQ(told["class_source"], "metadata");
  EXPECT_THAT(told["classes"].get<std::vector<std::string>>(),
              IsSupersetOf({"person", "chair", "tv", "laptop", "keyboard", "book", "potted plant",
                            "dining table", "couch", "cup"}));
}

TEST_F(ShippedNetwork, FindsPeopleAndChairsInScenesThatItHasNotSeen) {
  look_at("demo", {30, 150, 240, 330, 420, 510});
  look_at("office_walking_xyz", {30, 90, 150, 210, 270});
  ASSERT_GE(overlaps_["person"].size(), 10U);
  ASSERT_GE(overlaps_["chair"].size(), 10U);
  const Overlap people = overlap_of("person");
  const Overlap chairs = overlap_of("chair");
  // What was measured when they were set: 0.39 and 0.64, 0.46 and 0.70; untrained it is 0.
  EXPECT_GE(people.all, 0.3);
  EXPECT_GE(people.best_half, 0.5);
  EXPECT_GE(chairs.all, 0.35);
  EXPECT_GE(chairs.best_half, 0.55);
}

}  // namespace
}  // namespace tsg
