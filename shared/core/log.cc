#include "shared/core/log.h"

#include <spdlog/sinks/basic_file_sink.h>
#include <spdlog/sinks/null_sink.h>
#include <spdlog/sinks/stdout_color_sinks.h>

#include <vector>

namespace lararium {

Result<std::shared_ptr<Log>> MakeLog(const std::filesystem::path& file) {
  std::vector<spdlog::sink_ptr> sinks = {std::make_shared<spdlog::sinks::stderr_color_sink_mt>()};
  if (!file.empty()) {
    try {
      sinks.push_back(std::make_shared<spdlog::sinks::basic_file_sink_mt>(file.string()));
    } catch (const spdlog::spdlog_ex& error) {
      return Status::Error(file.string(), error.what(), "name a log file that can be written");
    }
  }
  auto log = std::make_shared<Log>("lararium", sinks.begin(), sinks.end());
  log->set_pattern("%^%l%$ %v");
  if (sinks.size() > 1) {
    sinks.back()->set_pattern("%Y-%m-%d %H:%M:%S.%e %l %v");
    log->flush_on(spdlog::level::warn);
  }
  return log;
}

std::shared_ptr<Log> MakeSilentLog() {
  return std::make_shared<Log>("silent", std::make_shared<spdlog::sinks::null_sink_mt>());
}

}  // namespace lararium
