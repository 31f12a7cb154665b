#include "common/core/atomic_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>
#include <fstream>
#include <iterator>
#include <string>

namespace tsg {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

std::string content_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

std::size_t entries_in(const fs::path& folder) {
  return static_cast<std::size_t>(
      std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

/// Lets this process write files of at most `bytes`: what a full disk looks like to a writer.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) : old_handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    ::getrlimit(RLIMIT_FSIZE, &old_limit_);
    const rlimit limit{bytes, old_limit_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileSizeLimit() {
    ::setrlimit(RLIMIT_FSIZE, &old_limit_);
    std::signal(SIGXFSZ, old_handler_);
  }
  FileSizeLimit(const FileSizeLimit&) = delete;
  FileSizeLimit& operator=(const FileSizeLimit&) = delete;
  FileSizeLimit(FileSizeLimit&&) = delete;
  FileSizeLimit& operator=(FileSizeLimit&&) = delete;

 private:
  rlimit old_limit_{};
  void (*old_handler_)(int);
};

class AtomicFile : public ::testing::Test {
 protected:
  void SetUp() override {
    std::string name = (fs::temp_directory_path() / "tsg_atomic_file_XXXXXX").string();
    ASSERT_NE(::mkdtemp(name.data()), nullptr);
    folder_ = name;
  }
  void TearDown() override { fs::remove_all(folder_); }

  fs::path folder_;
};

TEST_F(AtomicFile, HoldsWhatWasWrittenAndNothingElseIsLeft) {
  const std::string content(200'000, 'x');
  ASSERT_TRUE(write_file_atomically(folder_ / "a.txt", content));
  EXPECT_EQ(content_of(folder_ / "a.txt"), content);
  EXPECT_EQ(entries_in(folder_), 1U);
}

TEST_F(AtomicFile, TakesStreamedContentAndReplacesAnOlderFile) {
  ASSERT_TRUE(write_file_atomically(folder_ / "a.txt", "old"));
  ASSERT_TRUE(write_file_atomically(folder_ / "a.txt", [](std::ostream& s) { s << "new " << 7; }));
  EXPECT_EQ(content_of(folder_ / "a.txt"), "new 7");
}

TEST_F(AtomicFile, IsNotThereBeforeItIsComplete) {
  const fs::path path = folder_ / "a.txt";
  bool was_there = true;
  ASSERT_TRUE(write_file_atomically(path, [&](std::ostream& stream) {
    stream << "half" << std::flush;
    was_there = fs::exists(path);
  }));
  EXPECT_FALSE(was_there);
}

TEST_F(AtomicFile, IsReadableAsTheUmaskSays) {
  const mode_t old_mask = ::umask(022);
  ASSERT_TRUE(write_file_atomically(folder_ / "a.txt", "x"));
  ::umask(old_mask);
  EXPECT_EQ(static_cast<int>(fs::status(folder_ / "a.txt").permissions()), 0644);
}

TEST_F(AtomicFile, ReplacesTheFileBehindALinkNotTheLink) {
  ASSERT_TRUE(write_file_atomically(folder_ / "a.txt", "old"));
  fs::create_symlink(folder_ / "a.txt", folder_ / "link.txt");
  ASSERT_TRUE(write_file_atomically(folder_ / "link.txt", "new"));
  EXPECT_TRUE(fs::is_symlink(folder_ / "link.txt"));
  EXPECT_EQ(content_of(folder_ / "a.txt"), "new");
}

TEST_F(AtomicFile, LeavesTheOldFileAloneWhenTheDiskIsFull) {
  ASSERT_TRUE(write_file_atomically(folder_ / "a.txt", "old"));
  const FileSizeLimit limit(100'000);
  const auto result = write_file_atomically(folder_ / "a.txt", std::string(200'000, 'x'));
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, ExitCode::kCannotWrite);
  EXPECT_EQ(content_of(folder_ / "a.txt"), "old");
  EXPECT_EQ(entries_in(folder_), 1U);
}

TEST_F(AtomicFile, FullDeviceIsAnErrorThatNamesPathAndFix) {
  const auto result = write_file_atomically("/dev/full", "x");
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, ExitCode::kCannotWrite);
  EXPECT_THAT(result.error().message, HasSubstr("/dev/full: No space left on device"));
  EXPECT_THAT(result.error().message, HasSubstr("free some disk space"));
  EXPECT_TRUE(fs::is_character_file("/dev/full"));
}

TEST_F(AtomicFile, WriterThatGivesUpIsAnErrorAndLeavesNothing) {
  const auto result = write_file_atomically(
      folder_ / "a.txt", [](std::ostream& stream) { stream.setstate(std::ios::failbit); });
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, ExitCode::kCannotWrite);
  EXPECT_EQ(entries_in(folder_), 0U);
}

TEST_F(AtomicFile, AbsentFolderIsAnErrorThatNamesPathAndFix) {
  const auto result = write_file_atomically(folder_ / "absent" / "a.txt", "x");
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, ExitCode::kCannotWrite);
  EXPECT_THAT(result.error().message, HasSubstr("absent/a.txt"));
  EXPECT_THAT(result.error().message, HasSubstr("create the folder first"));
}

TEST_F(AtomicFile, FolderOfThatNameIsAnError) {
  const auto result = write_file_atomically(folder_, "x");
  ASSERT_FALSE(result);
  EXPECT_THAT(result.error().message, HasSubstr("not a folder"));
}

TEST_F(AtomicFile, UnwritableFolderIsAnErrorThatNamesTheFix) {
  // sysfs lets nobody create files, root included.
  const auto result = write_file_atomically("/sys/kernel/tsg.txt", "x");
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, ExitCode::kCannotWrite);
  EXPECT_THAT(result.error().message, HasSubstr("make the folder writable"));
}

TEST_F(AtomicFile, FoldersAreMadeWithThoseAboveThem) {
  ASSERT_TRUE(make_folder(folder_ / "b" / "c"));
  EXPECT_TRUE(fs::is_directory(folder_ / "b" / "c"));
  EXPECT_TRUE(make_folder(folder_ / "b" / "c"));
}

TEST_F(AtomicFile, FolderUnderAFileCannotBeMade) {
  ASSERT_TRUE(write_file_atomically(folder_ / "file", "x"));
  const auto result = make_folder(folder_ / "file" / "c");
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, ExitCode::kCannotWrite);
}

}  // namespace
}  // namespace tsg
