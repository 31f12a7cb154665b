#pragma once

#include <cstdint>
#include <initializer_list>
#include <memory>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

namespace tsg {

enum class LogLevel { kDebug, kInfo, kWarn, kError };

/// One key=value of a log line.
struct LogField {
  std::string_view key;
  std::string value;

  LogField(std::string_view k, std::string v) : key(k), value(std::move(v)) {}
  LogField(std::string_view k, const char* v) : key(k), value(v) {}
  template <typename T>
  requires std::is_arithmetic_v<T> LogField(std::string_view k, T v)
      : key(k), value(std::to_string(v)) {}
};

/// Writes lines "level service: event key=value ..." to stderr, with the priority prefix that
/// journald reads when stderr is the journal. Thread-safe. Nodes log, libraries do not.
class Log {
 public:
  explicit Log(const std::string& service, LogLevel least = LogLevel::kInfo);

  void debug(std::string_view event, std::initializer_list<LogField> fields = {});
  void info(std::string_view event, std::initializer_list<LogField> fields = {});
  /// Repeats of one event within a second are counted and written as one line.
  void warn(std::string_view event, std::initializer_list<LogField> fields = {});
  void error(std::string_view event, std::initializer_list<LogField> fields = {});

 private:
  struct Impl;
  std::shared_ptr<Impl> impl_;
};

}  // namespace tsg
