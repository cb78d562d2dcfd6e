#include "shared/core/log.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <spdlog/logger.h>
#include <spdlog/pattern_formatter.h>
#include <spdlog/sinks/base_sink.h>
#include <spdlog/sinks/null_sink.h>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <mutex>
#include <string_view>
#include <system_error>

namespace lararium {
namespace {

// Writes to a file whose disk may be full for a while. Lines are then counted instead of written,
// the log's other sinks are told once, and the file continues as soon as it accepts lines again.
class FileSink final : public spdlog::sinks::base_sink<std::mutex> {
 public:
  FileSink(int descriptor, std::string name) : descriptor_(descriptor), name_(std::move(name)) {}
  ~FileSink() override { close(descriptor_); }
  FileSink(const FileSink&) = delete;
  FileSink& operator=(const FileSink&) = delete;

  // Sets the log that this sink belongs to.
  void SetLog(const spdlog::logger* log) { log_ = log; }

 protected:
  void sink_it_(const spdlog::details::log_msg& message) override {
    spdlog::memory_buf_t line;
    formatter_->format(message, line);
    if (lost_ > 0) {
      const std::string gap =
          fmt::format("{}{} lines could not be written here\n", torn_ ? "\n" : "", lost_);
      if (!Write(gap)) {
        ++lost_;
        return;
      }
      Tell(spdlog::level::info,
           fmt::format("{}: is written again, without {} lines", name_, lost_));
      lost_ = 0;
    }
    if (!Write({line.data(), line.size()})) {
      lost_ = 1;
      Tell(spdlog::level::warn, fmt::format("{}: the log cannot be written: {}", name_,
                                            std::generic_category().message(errno)));
    }
  }
  void flush_() override {}  // Each line is written at once.

 private:
  bool Write(std::string_view text) {
    while (!text.empty()) {
      const ssize_t written = write(descriptor_, text.data(), text.size());
      if (written < 0) {
        return false;
      }
      text.remove_prefix(static_cast<size_t>(written));
      torn_ = !text.empty();
    }
    return true;
  }

  void Tell(spdlog::level::level_enum level, const std::string& text) const {
    for (const spdlog::sink_ptr& sink : log_->sinks()) {
      if (sink.get() != this && sink->should_log(level)) {
        sink->log({log_->name(), level, text});
      }
    }
  }

  int descriptor_;
  std::string name_;
  const spdlog::logger* log_ = nullptr;
  int64_t lost_ = 0;   // Lines lost since the file was full.
  bool torn_ = false;  // True if the last line is incomplete.
};

Result<std::shared_ptr<FileSink>> OpenFile(const std::filesystem::path& file) {
  std::error_code ignored;  // Opening the file reports it.
  std::filesystem::create_directories(file.parent_path(), ignored);
  const int descriptor = open(file.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0644);
  if (descriptor < 0) {
    return Status::Error(file.string(),
                         "cannot be opened: " + std::generic_category().message(errno),
                         "name a log file that can be written");
  }
  return std::make_shared<FileSink>(descriptor, file.string());
}

spdlog::level::level_enum LevelOf(Log::Level level) {
  switch (level) {
    case Log::Level::kDebug:
      return spdlog::level::debug;
    case Log::Level::kInfo:
      return spdlog::level::info;
    case Log::Level::kWarning:
      return spdlog::level::warn;
    case Log::Level::kError:
      return spdlog::level::err;
  }
  return spdlog::level::err;
}

}  // namespace

Log::Log(std::string name, spdlog::sink_ptr sink)
    : logger_(std::make_unique<spdlog::logger>(std::move(name), std::move(sink))) {}

Log::~Log() = default;

void Log::SetLevel(Level level) { logger_->set_level(LevelOf(level)); }

void Log::Write(Level level, fmt::string_view format, fmt::format_args values) {
  if (logger_->should_log(LevelOf(level))) {
    logger_->log(LevelOf(level), fmt::vformat(format, values));
  }
}

Result<std::shared_ptr<Log>> MakeLog(const std::filesystem::path& file) {
  auto log =
      std::make_shared<Log>("lararium", std::make_shared<spdlog::sinks::stderr_color_sink_mt>());
  log->logger().set_pattern("%^%l%$ %v");
  if (!file.empty()) {
    LARARIUM_ASSIGN_OR_RETURN(const std::shared_ptr<FileSink> sink, OpenFile(file));
    sink->SetLog(&log->logger());
    sink->set_pattern("%Y-%m-%d %H:%M:%S.%e %l %v");
    log->logger().sinks().push_back(sink);
  }
  return log;
}

std::shared_ptr<Log> MakeSilentLog() {
  return std::make_shared<Log>("silent", std::make_shared<spdlog::sinks::null_sink_mt>());
}

}  // namespace lararium
