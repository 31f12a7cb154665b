#include "services/segmentation/config.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "common/core/error.hpp"

namespace tsg {
namespace {

using testing::HasSubstr;

TEST(SegmentationConfig, IsReadFromItsSection) {
  const SegmentationConfig config = load_segmentation_config(ConfigFile::from_overrides(
      {"segmentation.provider=dataset", "segmentation.nice=7", "segmentation.cpus=0-1",
       "segmentation.model.provider=cuda", "segmentation.model.provider_required=true",
       "segmentation.dataset.folder=/data", "segmentation.input=network",
       "segmentation.remote.jpeg_quality=70", "segmentation.remote.frames_under_way=3",
       "segmentation.remote.patience_ms=500", "segmentation.model.file=/model.onnx",
       "segmentation.model.labels=/coco.txt",
       "segmentation.model.runtime_library=/libonnxruntime.so", "segmentation.model.threads=3",
       "segmentation.model.score_threshold=0.4", "segmentation.model.nms_iou=0.7"}));
  EXPECT_EQ(config.provider, "dataset");
  EXPECT_EQ(config.scheduling.nice, 7);
  EXPECT_EQ(config.scheduling.cpus, "0-1");
  EXPECT_EQ(config.network.model.provider, "cuda");
  EXPECT_TRUE(config.network.model.provider_required);
  EXPECT_EQ(config.dataset_folder, "/data");
  EXPECT_EQ(config.input, "network");
  EXPECT_EQ(config.remote.jpeg_quality, 70);
  EXPECT_EQ(config.remote.frames_under_way, 3);
  EXPECT_EQ(config.remote.patience_ms, 500);
  EXPECT_EQ(config.network.model.file, "/model.onnx");
  EXPECT_FALSE(config.uses_shipped_network);
  EXPECT_EQ(config.network.labels_file, "/coco.txt");
  EXPECT_EQ(config.network.model.runtime_library, "/libonnxruntime.so");
  EXPECT_EQ(config.network.model.threads, 3);
  EXPECT_DOUBLE_EQ(config.network.decoder.score_threshold, 0.4);
  EXPECT_DOUBLE_EQ(config.network.decoder.nms_iou, 0.7);
}

TEST(SegmentationConfig, NamesTheShippedNetworkWhereNoneIsNamed) {
  const SegmentationConfig config = load_segmentation_config(ConfigFile::from_overrides({}));
  EXPECT_EQ(std::filesystem::path(config.network.model.file).filename(), "solov2-rooms.onnx");
  EXPECT_TRUE(std::filesystem::exists(config.network.model.file));
  EXPECT_TRUE(config.uses_shipped_network);
  EXPECT_EQ(config.network.labels_file, "") << "its classes are in the file";
}

TEST(SegmentationConfig, HasNoFaultsUnlessTheyAreAskedFor) {
  EXPECT_FALSE(load_segmentation_config(ConfigFile::from_overrides({})).faults.any());
  const MaskFaults faults =
      load_segmentation_config(
          ConfigFile::from_overrides(
              {"segmentation.faults.late_frames=6", "segmentation.faults.every_frames=10",
               "segmentation.faults.drop_every=4", "segmentation.faults.drop_instance_every=3",
               "segmentation.faults.merge_two=true", "segmentation.faults.shrink_px=9",
               "segmentation.faults.swap_class_every=5"}))
          .faults;
  EXPECT_EQ(to_text(faults),
            "late_frames=6, every_frames=10, drop_every=4, drop_instance_every=3, merge_two=true, "
            "shrink_px=9, swap_class_every=5");
}

TEST(SegmentationConfig, NamesEveryKeyThatIsOutOfRange) {
  const ConfigFile file = ConfigFile::from_overrides(
      {"segmentation.provider=magic", "segmentation.nice=-3", "segmentation.cpus=all",
       "segmentation.model.provider=gpu", "segmentation.model.threads=0",
       "segmentation.input=radio", "segmentation.remote.jpeg_quality=101",
       "segmentation.remote.frames_under_way=0", "segmentation.remote.patience_ms=0",
       "segmentation.model.score_threshold=1.5", "segmentation.model.nms_iou=0",
       "segmentation.faults.late_frames=-1", "segmentation.faults.every_frames=0",
       "segmentation.faults.merge_two=3"});
  try {
    const SegmentationConfig config = load_segmentation_config(file);
    FAIL() << "accepted provider " << config.provider;
  } catch (const FatalError& error) {
    EXPECT_EQ(error.code(), ExitCode::kConfig);
    for (const char* key :
         {"segmentation.provider", "segmentation.nice", "segmentation.cpus", "segmentation.input",
          "segmentation.remote.jpeg_quality", "segmentation.remote.frames_under_way",
          "segmentation.remote.patience_ms", "segmentation.model.provider must be",
          "segmentation.model.threads", "segmentation.model.score_threshold",
          "segmentation.model.nms_iou", "segmentation.faults.late_frames",
          "segmentation.faults.every_frames", "segmentation.faults.merge_two"}) {
      EXPECT_THAT(error.what(), HasSubstr(key));
    }
  }
}

/// What is said of a configuration; empty where it is accepted.
std::string said_of(const std::vector<std::string>& overrides) {
  try {
    (void)load_segmentation_config(ConfigFile::from_overrides(overrides));
    return {};
  } catch (const FatalError& error) {
    return error.what();
  }
}

TEST(SegmentationConfig, RefusesWhatDoesNotGoTogether) {
  EXPECT_EQ(said_of({"segmentation.provider=remote"}), "");
  EXPECT_THAT(said_of({"segmentation.provider=remote", "segmentation.input=network"}),
              HasSubstr("a host that works for another does not send frames on"));
  EXPECT_THAT(said_of({"segmentation.provider=remote", "segmentation.faults.drop_every=2"}),
              HasSubstr("faults work with input camera"));
}

}  // namespace
}  // namespace tsg
