// deploy/fetch-tum against a server on this machine: archives like those of the TUM benchmark.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "common/core/error.hpp"
#include "tests/support/file_server.hpp"
#include "tests/support/tiny_disk.hpp"

namespace tsg {
namespace {

namespace fs = std::filesystem;
using test::code;
using test::content_of;
using test::FileServer;
using test::ProgramResult;
using test::TempFolder;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

const std::string kFolder = "rgbd_dataset_freiburg1_xyz";
const std::string kArchive = "freiburg1/" + kFolder + ".tgz";

/// Makes an archive of a sequence; `note` makes one differ from another.
void write_archive(const TempFolder& site, const std::string& note = "") {
  const TempFolder work;
  const fs::path folder = kFolder;
  work.write(folder / "rgb.txt", "# color images\n1305031102.175304 rgb/1305031102.175304.png\n");
  work.write(folder / "depth.txt", "# depth maps\n1305031102.160407 depth/1305031102.160407.png\n");
  work.write(folder / "groundtruth.txt",
             "1305031098.6659 1.3563 0.6305 1.6380 0.6 0.6 -0.3 -0.3\n");
  work.write(folder / "accelerometer.txt", "1305031098.6711 -0.0001 8.1716 -4.4 " + note + "\n");
  std::string noise;  // what hardly gets smaller, so that the archive is some kilobytes
  for (unsigned i = 0, x = 1; i < 60'000; ++i)
    noise += static_cast<char>((x = x * 69069 + 1) >> 24);
  work.write(folder / "rgb/1305031102.175304.png", noise);
  fs::create_directories(site / "freiburg1");
  const ProgramResult made = test::run_program(
      "tar", {"-czf", (site / kArchive).string(), "-C", work.path().string(), kFolder});
  ASSERT_EQ(made.end.exit_code, 0) << made.output;
}

class FetchTum : public ::testing::Test {
 protected:
  void SetUp() override { write_archive(site_); }

  [[nodiscard]] ProgramResult fetch(const std::string& url,
                                    std::vector<std::string> arguments) const {
    arguments.insert(arguments.end(), {"--data", data().string()});
    return fetch_with(url, arguments);
  }
  [[nodiscard]] static ProgramResult fetch_with(const std::string& url,
                                                std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(),
                     {"TSG_TUM_URL=" + url, "no_proxy=*", TSG_SOURCE_DIR "/deploy/fetch-tum"});
    return test::run_program("env", arguments, std::chrono::minutes(2));
  }
  [[nodiscard]] fs::path data() const { return folder_ / "data"; }
  [[nodiscard]] fs::path fetched() const { return data() / kFolder; }
  /// Files in the data folder but hidden ones.
  [[nodiscard]] std::vector<std::string> files() const {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(data())) {
      const std::string name = entry.path().filename();
      if (name != ".lock") names.push_back(name);
    }
    std::sort(names.begin(), names.end());
    return names;
  }

  TempFolder site_;
  TempFolder folder_;
};

TEST_F(FetchTum, DownloadsUnpacksNotesTheChecksumAndLeavesNothingElse) {
  const FileServer server(site_.path());
  const ProgramResult result = fetch(server.url(), {"fr1/xyz"});
  ASSERT_EQ(result.end.exit_code, 0) << result.output;
  EXPECT_THAT(result.output, HasSubstr(fetched().string() + "\n"));
  EXPECT_THAT(content_of(fetched() / "accelerometer.txt"), HasSubstr("8.1716"));
  EXPECT_EQ(files(), (std::vector<std::string>{"SHA256SUMS", kFolder}));
  EXPECT_THAT(content_of(data() / "SHA256SUMS"), HasSubstr("  " + kFolder + ".tgz\n"));
}

TEST_F(FetchTum, DoesNotAskForWhatIsThere) {
  const FileServer server(site_.path());
  ASSERT_EQ(fetch(server.url(), {"fr1/xyz"}).end.exit_code, 0);
  const std::string requests = server.requests();
  const ProgramResult again = fetch(server.url(), {kFolder});
  EXPECT_EQ(again.end.exit_code, 0) << again.output;
  EXPECT_THAT(again.output, HasSubstr(fetched().string()));
  EXPECT_EQ(server.requests(), requests);
}

TEST_F(FetchTum, GoesOnWhereTheConnectionBroke) {
  constexpr int kBreakAfter = 20'000;
  {
    const FileServer server(site_.path(), kBreakAfter);
    const ProgramResult broken = fetch(server.url(), {"fr1/xyz"});
    EXPECT_EQ(broken.end.exit_code, code(ExitCode::kUnavailable)) << broken.output;
    EXPECT_THAT(broken.output, HasSubstr("goes on where it stopped"));
    EXPECT_FALSE(fs::exists(fetched()));
  }
  const auto have = fs::file_size(data() / (kFolder + ".tgz.part"));
  EXPECT_GE(have, kBreakAfter);
  const FileServer server(site_.path());
  const ProgramResult result = fetch(server.url(), {"fr1/xyz"});
  EXPECT_EQ(result.end.exit_code, 0) << result.output;
  EXPECT_TRUE(fs::exists(fetched() / "groundtruth.txt"));
  EXPECT_EQ(server.requests(), "GET /" + kArchive + " " + std::to_string(have) + "\n");
}

TEST_F(FetchTum, BeginsAnewWhereWhatIsThereIsNoBeginning) {
  const FileServer server(site_.path());
  folder_.write("data/" + kFolder + ".tgz.part", std::string(200'000, 'x'));
  const ProgramResult result = fetch(server.url(), {"fr1/xyz"});
  EXPECT_EQ(result.end.exit_code, 0) << result.output;
  EXPECT_TRUE(fs::exists(fetched() / "groundtruth.txt"));
}

TEST_F(FetchTum, DamagedArchiveIsToldAndRemoved) {
  fs::resize_file(site_ / kArchive, fs::file_size(site_ / kArchive) / 2);
  const FileServer server(site_.path());
  const ProgramResult result = fetch(server.url(), {"fr1/xyz"});
  EXPECT_EQ(result.end.exit_code, code(ExitCode::kBadData)) << result.output;
  EXPECT_THAT(result.output, AllOf(HasSubstr(kFolder + ".tgz is damaged"), HasSubstr("again")));
  EXPECT_TRUE(files().empty()) << files().front();
}

TEST_F(FetchTum, AnotherArchiveOfTheSameNameIsRefused) {
  {
    const FileServer server(site_.path());
    ASSERT_EQ(fetch(server.url(), {"fr1/xyz"}).end.exit_code, 0);
  }
  fs::remove_all(fetched());
  write_archive(site_, "changed");
  const FileServer server(site_.path());
  const ProgramResult result = fetch(server.url(), {"fr1/xyz"});
  EXPECT_EQ(result.end.exit_code, code(ExitCode::kBadData)) << result.output;
  EXPECT_THAT(result.output, HasSubstr("not what it was when it was first fetched"));
  EXPECT_FALSE(fs::exists(fetched()));
}

TEST_F(FetchTum, SequenceThatTheSiteDoesNotHaveIsNamed) {
  const FileServer server(site_.path());
  const ProgramResult result = fetch(server.url(), {"fr1/xyz", "fr3/flying_carpet"});
  EXPECT_EQ(result.end.exit_code, code(ExitCode::kMissingInput)) << result.output;
  EXPECT_THAT(result.output,
              AllOf(HasSubstr("freiburg3_flying_carpet.tgz (404)"), HasSubstr(fetched().string())));
}

TEST_F(FetchTum, ServerThatDoesNotAnswerIsNamed) {
  const ProgramResult result = fetch("http://127.0.0.1:9", {"fr1/xyz"});
  EXPECT_EQ(result.end.exit_code, code(ExitCode::kUnavailable)) << result.output;
  EXPECT_THAT(result.output, AllOf(HasSubstr("cannot reach http://127.0.0.1:9/freiburg1"),
                                   HasSubstr("TSG_TUM_URL")));
}

TEST_F(FetchTum, MistakesInNamesAreToldBeforeAnyDownload) {
  const FileServer server(site_.path());
  for (const std::string name : {"fr4/xyz", "walking", "../../etc", "--every"}) {
    const ProgramResult result = fetch(server.url(), {"fr1/xyz", name});
    EXPECT_EQ(result.end.exit_code, code(ExitCode::kUsage)) << result.output;
    EXPECT_THAT(result.output, HasSubstr(name));
  }
  EXPECT_EQ(fetch(server.url(), {}).end.exit_code, code(ExitCode::kUsage));
  EXPECT_EQ(server.requests(), "");
}

TEST_F(FetchTum, ListTellsWhatIsThere) {
  folder_.write("data/rgbd_dataset_freiburg1_desk/groundtruth.txt", "0 0 0 0 0 0 0 1\n");
  const ProgramResult result = fetch("http://127.0.0.1:9", {"--list"});
  EXPECT_EQ(result.end.exit_code, 0);
  EXPECT_THAT(result.output, HasSubstr((data() / "rgbd_dataset_freiburg1_desk\n").string()));
  EXPECT_THAT(result.output, HasSubstr("fr3/walking_xyz      -\n"));
}

TEST_F(FetchTum, FullDiskIsNamed) {
  const FileServer server(site_.path());
  for (const char* size : {"16k", "80k"}) {  // too small for the archive; for what is in it
    const test::TinyDisk disk(size);
    if (!disk.is_mounted()) GTEST_SKIP() << "no right to mount: a full disk cannot be made here";
    const ProgramResult result =
        fetch_with(server.url(), {"fr1/xyz", "--data", disk.path().string()});
    EXPECT_EQ(result.end.exit_code, code(ExitCode::kCannotWrite)) << result.output;
    EXPECT_THAT(result.output, AllOf(HasSubstr(disk.path().string()), HasSubstr("make room")));
    EXPECT_FALSE(fs::exists(disk.path() / kFolder));
  }
}

}  // namespace
}  // namespace tsg
