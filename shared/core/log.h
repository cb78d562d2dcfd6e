#pragma once

// Logging with spdlog, whose headers most sources are spared. The log is passed as an argument and
// is never a global.

#include <fmt/core.h>

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

#include "shared/core/status.h"

namespace spdlog {
class logger;
namespace sinks {
class sink;
}  // namespace sinks
}  // namespace spdlog

namespace lararium {

class Log {
 public:
  enum class Level { kDebug, kInfo, kWarning, kError };

  Log(std::string name, std::shared_ptr<spdlog::sinks::sink> sink);
  ~Log();
  Log(const Log&) = delete;
  Log& operator=(const Log&) = delete;

  // Write a line, from any thread. With values, the text is a format of fmt.
  void Debug(std::string_view text) { Write(Level::kDebug, text); }
  void Info(std::string_view text) { Write(Level::kInfo, text); }
  void Warn(std::string_view text) { Write(Level::kWarning, text); }
  void Error(std::string_view text) { Write(Level::kError, text); }
  template <typename Value, typename... Values>
  void Debug(fmt::format_string<Value, Values...> text, Value&& value, Values&&... values) {
    Write(Level::kDebug, text, fmt::make_format_args(value, values...));
  }
  template <typename Value, typename... Values>
  void Info(fmt::format_string<Value, Values...> text, Value&& value, Values&&... values) {
    Write(Level::kInfo, text, fmt::make_format_args(value, values...));
  }
  template <typename Value, typename... Values>
  void Warn(fmt::format_string<Value, Values...> text, Value&& value, Values&&... values) {
    Write(Level::kWarning, text, fmt::make_format_args(value, values...));
  }
  template <typename Value, typename... Values>
  void Error(fmt::format_string<Value, Values...> text, Value&& value, Values&&... values) {
    Write(Level::kError, text, fmt::make_format_args(value, values...));
  }

  // Leaves out less important lines from now on.
  void SetLevel(Level level);
  // The logger that writes. Its sinks may be changed while no other thread writes.
  spdlog::logger& logger() { return *logger_; }

 private:
  void Write(Level level, std::string_view text);
  void Write(Level level, fmt::string_view format, fmt::format_args values);

  std::unique_ptr<spdlog::logger> logger_;
};

// Creates a log to stderr and, if `file` is not empty, to that file.
Result<std::shared_ptr<Log>> MakeLog(const std::filesystem::path& file = {});

// For tests and tools without output.
std::shared_ptr<Log> MakeSilentLog();

}  // namespace lararium
