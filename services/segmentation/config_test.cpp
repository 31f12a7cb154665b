#include "services/segmentation/config.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/core/error.hpp"

namespace tsg {
namespace {

using testing::HasSubstr;

TEST(SegmentationConfig, IsReadFromItsSection) {
  const SegmentationConfig config = load_segmentation_config(ConfigFile::from_overrides(
      {"segmentation.provider=dataset", "segmentation.nice=7", "segmentation.dataset.folder=/data",
       "segmentation.model.file=/model.onnx",
       "segmentation.model.runtime_library=/libonnxruntime.so", "segmentation.model.threads=3",
       "segmentation.model.score_threshold=0.4", "segmentation.model.nms_iou=0.7"}));
  EXPECT_EQ(config.provider, "dataset");
  EXPECT_EQ(config.nice, 7);
  EXPECT_EQ(config.dataset_folder, "/data");
  EXPECT_EQ(config.network.model.file, "/model.onnx");
  EXPECT_EQ(config.network.model.runtime_library, "/libonnxruntime.so");
  EXPECT_EQ(config.network.model.threads, 3);
  EXPECT_DOUBLE_EQ(config.network.decoder.score_threshold, 0.4);
  EXPECT_DOUBLE_EQ(config.network.decoder.nms_iou, 0.7);
}

TEST(SegmentationConfig, NamesEveryKeyThatIsOutOfRange) {
  const ConfigFile file = ConfigFile::from_overrides(
      {"segmentation.provider=magic", "segmentation.nice=-3", "segmentation.model.threads=0",
       "segmentation.model.score_threshold=1.5", "segmentation.model.nms_iou=0"});
  try {
    const SegmentationConfig config = load_segmentation_config(file);
    FAIL() << "accepted provider " << config.provider;
  } catch (const FatalError& error) {
    EXPECT_EQ(error.code(), ExitCode::kConfig);
    for (const char* key :
         {"segmentation.provider", "segmentation.nice", "segmentation.model.threads",
          "segmentation.model.score_threshold", "segmentation.model.nms_iou"}) {
      EXPECT_THAT(error.what(), HasSubstr(key));
    }
  }
}

}  // namespace
}  // namespace tsg
