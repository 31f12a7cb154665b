#pragma once

#include <cerrno>
#include <stdexcept>
#include <string>
#include <system_error>
#include <tl/expected.hpp>
#include <utility>

namespace tsg {

/// Process exit codes, one for each kind of failure that a caller may want to tell apart
/// (docs/exit-codes.md). Values follow sysexits.h where it has a word for the case.
enum class ExitCode : int {
  kOk = 0,
  kFailure = 1,            ///< anything without a code of its own
  kUsage = 64,             ///< wrong command-line arguments
  kBadData = 65,           ///< a file is damaged or not what its name says
  kMissingInput = 66,      ///< a file or folder that was named is not there
  kEmptyInput = 67,        ///< the input is there but holds nothing to work on
  kSizeMismatch = 68,      ///< images that belong together differ in size
  kUnavailable = 69,       ///< something that must run does not: RouDi, a service, a library
  kInternal = 70,          ///< a broken invariant of ours
  kServiceDied = 71,       ///< a supervised process ended by itself
  kInvalidNumber = 72,     ///< NaN or infinity where a number belongs
  kCannotWrite = 73,       ///< an output cannot be written: full disk, read-only folder
  kTimeout = 75,           ///< a peer did not answer in time
  kUnsupportedModel = 76,  ///< a segmentation model of a layout that we do not know
  kConfig = 78,            ///< the configuration is wrong; restarting does not help
  kInterrupted = 130,      ///< stopped by Ctrl-C (SIGINT) before the work was done
  kTerminated = 143,       ///< the same by SIGTERM
};

/// Why something failed, for whoever can act on it. The message names the thing and the fix.
struct Error {
  ExitCode code = ExitCode::kFailure;
  std::string message;
};

template <typename T>
using Expected = tl::expected<T, Error>;

[[nodiscard]] inline tl::unexpected<Error> make_error(ExitCode code, std::string message) {
  return tl::unexpected<Error>(Error{code, std::move(message)});
}

/// What errno says, e.g. "No space left on device"; thread-safe, unlike strerror().
[[nodiscard]] inline std::string errno_text() { return std::generic_category().message(errno); }

/// Thrown where a process cannot start or go on; only run_service() and tsgctl's main catch it.
class FatalError : public std::runtime_error {
 public:
  explicit FatalError(const Error& error) : std::runtime_error(error.message), code_(error.code) {}
  FatalError(ExitCode code, const std::string& message)
      : std::runtime_error(message), code_(code) {}
  [[nodiscard]] ExitCode code() const { return code_; }

 private:
  ExitCode code_;
};

/// The value, or its error thrown as FatalError: for start-up code, where nobody can act on it.
template <typename T>
[[nodiscard]] T value_or_throw(Expected<T> result) {
  if (!result) throw FatalError(result.error());
  return std::move(*result);
}

/// The same for operations that have nothing to return.
inline void throw_on_error(const Expected<void>& result) {
  if (!result) throw FatalError(result.error());
}

}  // namespace tsg
