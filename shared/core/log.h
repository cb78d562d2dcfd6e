#pragma once

// Logging with spdlog, whose headers most sources are spared. The log is passed as an argument and
// is never a global.

#include <fmt/core.h>

#include <filesystem>
#include <memory>
#include <string>

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

  // Write a line, from any thread. The text is a format of fmt.
  template <typename... Values>
  void Debug(fmt::format_string<Values...> text, Values&&... values) {
    Write(Level::kDebug, text, fmt::make_format_args(values...));
  }
  template <typename... Values>
  void Info(fmt::format_string<Values...> text, Values&&... values) {
    Write(Level::kInfo, text, fmt::make_format_args(values...));
  }
  template <typename... Values>
  void Warn(fmt::format_string<Values...> text, Values&&... values) {
    Write(Level::kWarning, text, fmt::make_format_args(values...));
  }
  template <typename... Values>
  void Error(fmt::format_string<Values...> text, Values&&... values) {
    Write(Level::kError, text, fmt::make_format_args(values...));
  }

  // Leaves out less important lines from now on.
  void SetLevel(Level level);
  // The logger that writes. Its sinks may be changed while no other thread writes.
  spdlog::logger& logger() { return *logger_; }

 private:
  void Write(Level level, fmt::string_view format, fmt::format_args values);

  std::unique_ptr<spdlog::logger> logger_;
};

// Creates a log to stderr and, if `file` is not empty, to that file.
Result<std::shared_ptr<Log>> MakeLog(const std::filesystem::path& file = {});

// For tests and tools without output.
std::shared_ptr<Log> MakeSilentLog();

}  // namespace lararium
