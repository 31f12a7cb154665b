#include "services/tsgctl/model/model_run.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>

#include "tests/support/temp_folder.hpp"
#include "tests/support/tiny_yolo_seg.hpp"

namespace tsg {
namespace {

using test::TempFolder;
using testing::HasSubstr;

class ModelRunTest : public ::testing::Test {
 protected:
  void add_image(const std::filesystem::path& name) const {
    std::filesystem::create_directories((folder_ / name).parent_path());
    const cv::Mat image(32, 64, CV_8UC3, cv::Scalar(90, 120, 150));
    ASSERT_TRUE(cv::imwrite((folder_ / name).string(), image));
  }

  [[nodiscard]] ModelRun run_of(const std::filesystem::path& input) const {
    const auto file = folder_.write("tiny.onnx", test::TinyYoloSeg{}.bytes());
    return {.provider = {.model = {.file = file}, .decoder = {}},
            .input = folder_ / input,
            .out = folder_ / "out",
            .pictures = false};
  }

  TempFolder folder_;
};

TEST_F(ModelRunTest, WritesLabelImagesAndWhatTheyShowByName) {
  add_image("in/b.png");
  add_image("in/a.jpg");
  std::vector<int> told;
  const auto ran = run_model(run_of("in"), [&](int done, int all) {
    told.push_back(done);
    EXPECT_EQ(all, 2);
  });
  ASSERT_TRUE(ran.has_value()) << ran.error().message;
  EXPECT_EQ(told, (std::vector<int>{1, 2}));

  const auto summary = nlohmann::json::parse(test::content_of(folder_ / "out/found.json"));
  ASSERT_EQ(summary["images"].size(), 2U);
  EXPECT_EQ(summary["images"][0]["image"], "a.jpg");
  EXPECT_EQ(summary["images"][1]["image"], "b.png");
  const auto& instance = summary["images"][1]["instances"].at(0);
  EXPECT_EQ(instance["class"], "person");
  EXPECT_NEAR(instance["score"], 0.9, 1e-3);
  const cv::Mat labels = cv::imread((folder_ / "out/mask/b.png").string(), cv::IMREAD_UNCHANGED);
  ASSERT_EQ(labels.size(), cv::Size(64, 32));
  EXPECT_EQ(labels.at<std::uint8_t>(16, 10), 1);
  EXPECT_EQ(labels.at<std::uint8_t>(16, 50), 0);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out/picture"));
}

TEST_F(ModelRunTest, DrawsPicturesWhereAskedTo) {
  add_image("in/a.png");
  ModelRun run = run_of("in");
  run.pictures = true;
  ASSERT_TRUE(run_model(run, [](int, int) {}).has_value());
  const cv::Mat picture = cv::imread((folder_ / "out/picture/a.png").string());
  ASSERT_EQ(picture.size(), cv::Size(128, 64));
  EXPECT_NE(picture.at<cv::Vec3b>(4, 4), cv::Vec3b(90, 120, 150));    // the person is tinted
  EXPECT_EQ(picture.at<cv::Vec3b>(4, 120), cv::Vec3b(90, 120, 150));  // what is beside is not
}

TEST_F(ModelRunTest, TakesTheColourImagesOfASequence) {
  add_image("sequence/rgb/1.png");
  add_image("sequence/depth/1.png");
  folder_.write("sequence/rgb.txt", "1 rgb/1.png\n");
  const auto images = colour_images(folder_ / "sequence");
  ASSERT_TRUE(images.has_value()) << images.error().message;
  EXPECT_EQ(*images, (std::vector<std::filesystem::path>{folder_ / "sequence/rgb/1.png"}));
}

TEST_F(ModelRunTest, NamesAFolderThatIsAbsentOrEmptyAndAnImageThatIsDamaged) {
  const auto absent = colour_images(folder_ / "nowhere");
  ASSERT_FALSE(absent.has_value());
  EXPECT_EQ(absent.error().code, ExitCode::kMissingInput);
  EXPECT_THAT(absent.error().message, HasSubstr("nowhere"));

  folder_.write("empty/notes.txt", "none");
  const auto empty = colour_images(folder_ / "empty");
  ASSERT_FALSE(empty.has_value());
  EXPECT_EQ(empty.error().code, ExitCode::kEmptyInput);

  folder_.write("bad/a.png", "no image");
  const auto bad = run_model(run_of("bad"), [](int, int) {});
  ASSERT_FALSE(bad.has_value());
  EXPECT_EQ(bad.error().code, ExitCode::kBadData);
  EXPECT_THAT(bad.error().message, HasSubstr("a.png"));
}

}  // namespace
}  // namespace tsg
