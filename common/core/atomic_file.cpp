#include "common/core/atomic_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <streambuf>
#include <string>
#include <system_error>
#include <utility>

namespace tsg {
namespace {

namespace fs = std::filesystem;

const char* fix_for(int error_number) {
  switch (error_number) {
    case ENOSPC:
    case EDQUOT:
    case EFBIG:
      return "free some disk space or choose another folder";
    case EACCES:
    case EPERM:
    case EROFS:
      return "make the folder writable for this user or choose another one";
    case ENOENT:
    case ENOTDIR:
      return "create the folder first or choose another one";
    case EISDIR:
      return "choose a name that is not a folder";
    default:
      return "choose another folder";
  }
}

tl::unexpected<Error> cannot_write(const fs::path& path, int error_number) {
  return make_error(ExitCode::kCannotWrite, "cannot write " + path.string() + ": " +
                                                std::generic_category().message(error_number) +
                                                "; " + fix_for(error_number));
}

/// Buffers what a stream writes and hands it to a file descriptor; keeps the first errno, which
/// standard file streams lose.
class DescriptorBuffer : public std::streambuf {
 public:
  explicit DescriptorBuffer(int descriptor) : descriptor_(descriptor) {
    setp(buffer_.data(), buffer_.data() + buffer_.size());
  }
  [[nodiscard]] int error_number() const { return error_number_; }

 protected:
  int_type overflow(int_type character) override {
    if (sync() != 0) return traits_type::eof();
    if (!traits_type::eq_int_type(character, traits_type::eof())) {
      *pptr() = traits_type::to_char_type(character);
      pbump(1);
    }
    return traits_type::not_eof(character);
  }

  int sync() override {
    const char* next = pbase();
    while (error_number_ == 0 && next < pptr()) {
      const ssize_t written = ::write(descriptor_, next, static_cast<std::size_t>(pptr() - next));
      if (written >= 0) {
        next += written;
      } else if (errno != EINTR) {
        error_number_ = errno;
      }
    }
    setp(buffer_.data(), buffer_.data() + buffer_.size());
    return error_number_ == 0 ? 0 : -1;
  }

 private:
  int descriptor_;
  int error_number_ = 0;
  std::array<char, 65536> buffer_;
};

/// Runs `write` on an open file, puts it on the disk and closes it. 0 or the errno.
int fill_and_close(int descriptor,
                   bool is_regular,
                   const std::function<void(std::ostream&)>& write) {
  DescriptorBuffer buffer(descriptor);
  std::ostream stream(&buffer);
  write(stream);
  stream.flush();
  int error_number = buffer.error_number();
  if (error_number == 0 && !stream) error_number = EIO;  // `write` itself gave up
  if (error_number == 0 && is_regular && ::fsync(descriptor) != 0) error_number = errno;
  if (::close(descriptor) != 0 && error_number == 0) error_number = errno;
  return error_number;
}

Expected<void> write_in_place(const fs::path& path,
                              const std::function<void(std::ostream&)>& write) {
  const int descriptor = ::open(path.c_str(), O_WRONLY | O_CLOEXEC);
  if (descriptor < 0) return cannot_write(path, errno);
  const int error_number = fill_and_close(descriptor, false, write);
  if (error_number != 0) return cannot_write(path, error_number);
  return {};
}

/// A rename is on the disk only once the folder is.
void sync_folder(const fs::path& folder) {
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return;  // not readable: the file is there all the same
  ::fsync(descriptor);
  ::close(descriptor);
}

Expected<void> write_and_rename(const fs::path& path,
                                const std::function<void(std::ostream&)>& write) {
  std::string temporary = path.string() + ".tmp-XXXXXX";
  const int descriptor = ::mkostemp(temporary.data(), O_CLOEXEC);
  if (descriptor < 0) return cannot_write(path, errno);
  const mode_t mask = ::umask(0);
  ::umask(mask);
  ::fchmod(descriptor, 0666 & ~mask);  // mkostemp makes private files, others may read results
  int error_number = fill_and_close(descriptor, true, write);
  if (error_number == 0 && ::rename(temporary.c_str(), path.c_str()) != 0) error_number = errno;
  if (error_number != 0) {
    ::unlink(temporary.c_str());
    return cannot_write(path, error_number);
  }
  sync_folder(path.has_parent_path() ? path.parent_path() : fs::path("."));
  return {};
}

}  // namespace

Expected<void> write_file_atomically(const fs::path& path,
                                     const std::function<void(std::ostream&)>& write) {
  std::error_code ignored;  // an absent file is no error, everything else shows at opening
  const fs::file_status status = fs::status(path, ignored);
  if (fs::is_directory(status)) return cannot_write(path, EISDIR);
  if (fs::exists(status) && !fs::is_regular_file(status)) return write_in_place(path, write);
  // A link keeps pointing to its file, so the file it points to is the one replaced.
  const fs::path target = fs::exists(status) ? fs::canonical(path, ignored) : path;
  return write_and_rename(target.empty() ? path : target, write);
}

Expected<void> write_file_atomically(const fs::path& path, std::string_view content) {
  return write_file_atomically(path, [content](std::ostream& stream) {
    stream.write(content.data(), static_cast<std::streamsize>(content.size()));
  });
}

Expected<void> make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) return cannot_write(folder, error.value());
  if (!fs::is_directory(folder, error)) return cannot_write(folder, ENOTDIR);
  return {};
}

}  // namespace tsg
