#include "common/app/log.hpp"

#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>

#include <cstdlib>
#include <map>
#include <mutex>

#include "common/core/time.hpp"

namespace tsg {
namespace {

constexpr std::int64_t kRepeatPeriodNs = 1'000'000'000;

spdlog::level::level_enum to_spdlog(LogLevel level) {
  switch (level) {
    case LogLevel::kDebug:
      return spdlog::level::debug;
    case LogLevel::kInfo:
      return spdlog::level::info;
    case LogLevel::kWarn:
      return spdlog::level::warn;
    case LogLevel::kError:
      return spdlog::level::err;
  }
  return spdlog::level::info;
}

/// The prefix by which journald knows a line's priority (sd-daemon(3)).
const char* journal_prefix(LogLevel level) {
  switch (level) {
    case LogLevel::kDebug:
      return "<7>";
    case LogLevel::kInfo:
      return "<6>";
    case LogLevel::kWarn:
      return "<4>";
    case LogLevel::kError:
      return "<3>";
  }
  return "<6>";
}

/// Quotes a value that would not read back as one word.
std::string quoted(const std::string& value) {
  if (!value.empty() && value.find_first_of(" \"=\n") == std::string::npos) return value;
  std::string result = "\"";
  for (const char c : value) {
    if (c == '"') result += '\\';
    result += c == '\n' ? ' ' : c;
  }
  return result + "\"";
}

// Where systemd has connected stderr to the journal it says so.
bool is_on_journal() {
  return std::getenv("JOURNAL_STREAM") != nullptr;  // NOLINT(concurrency-mt-unsafe): nobody sets it
}

}  // namespace

struct Log::Impl {
  Impl(const std::string& service, LogLevel least)
      : logger(service, std::make_shared<spdlog::sinks::stderr_sink_mt>()),
        to_journal(is_on_journal()) {
    logger.set_level(to_spdlog(least));
    logger.flush_on(spdlog::level::debug);
    // The journal stamps lines itself.
    logger.set_pattern(to_journal ? "%v" : "%H:%M:%S.%e %l %n: %v");
  }

  void write(LogLevel level, std::string_view event, std::initializer_list<LogField> fields) {
    std::string line = to_journal ? journal_prefix(level) : "";
    line += event;
    for (const LogField& field : fields) {
      line += " ";
      line += field.key;
      line += "=" + quoted(field.value);
    }
    logger.log(to_spdlog(level), line);
  }

  /// How many repeats this line stands for, itself included; 0 where it is held back.
  int admit(std::string_view event) {
    const std::scoped_lock lock(mutex);
    Repeats& seen = repeats[std::string(event)];
    ++seen.count;
    const std::int64_t now_ns = monotonic_ns();
    if (seen.written_ns != 0 && now_ns - seen.written_ns < kRepeatPeriodNs) return 0;
    seen.written_ns = now_ns;
    return std::exchange(seen.count, 0);
  }

  struct Repeats {
    std::int64_t written_ns = 0;
    int count = 0;
  };

  spdlog::logger logger;
  const bool to_journal;
  std::mutex mutex;  // guards repeats
  std::map<std::string, Repeats> repeats;
};

Log::Log(const std::string& service, LogLevel least)
    : impl_(std::make_shared<Impl>(service, least)) {}

void Log::debug(std::string_view event, std::initializer_list<LogField> fields) {
  impl_->write(LogLevel::kDebug, event, fields);
}

void Log::info(std::string_view event, std::initializer_list<LogField> fields) {
  impl_->write(LogLevel::kInfo, event, fields);
}

void Log::warn(std::string_view event, std::initializer_list<LogField> fields) {
  const int times = impl_->admit(event);
  if (times == 0) return;
  const std::string suffix = times > 1 ? " (" + std::to_string(times) + " times)" : "";
  impl_->write(LogLevel::kWarn, std::string(event) + suffix, fields);
}

void Log::error(std::string_view event, std::initializer_list<LogField> fields) {
  impl_->write(LogLevel::kError, event, fields);
}

}  // namespace tsg
