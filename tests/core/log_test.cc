#include "shared/core/log.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <spdlog/logger.h>
#include <spdlog/sinks/base_sink.h>
#include <sys/resource.h>
#include <unistd.h>

#include <csignal>
#include <fstream>
#include <iterator>
#include <mutex>
#include <string>
#include <vector>

#include "tests/support/test_files.h"

namespace lararium {
namespace {

class Ear final : public spdlog::sinks::base_sink<std::mutex> {
 public:
  std::vector<std::string> lines;

 protected:
  void sink_it_(const spdlog::details::log_msg& message) override {
    lines.emplace_back(message.payload.data(), message.payload.size());
  }
  void flush_() override {}
};

std::string Read(const std::filesystem::path& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

// While it exists, no file of this process can grow beyond `bytes`.
class SmallFiles {
 public:
  explicit SmallFiles(rlim_t bytes) {
    std::signal(SIGXFSZ, SIG_IGN);
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit small = {bytes, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &small);
  }
  ~SmallFiles() {
    setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, SIG_DFL);
  }
  SmallFiles(const SmallFiles&) = delete;
  SmallFiles& operator=(const SmallFiles&) = delete;

 private:
  rlimit before_ = {};
};

TEST(Log, AFullDiskIsToldOnceAndTheFileGoesOnWhenThereIsRoomAgain) {
  const test::TemporaryFolder folder;
  const std::filesystem::path path = folder / "new/log.txt";
  const std::shared_ptr<Log> log = MakeLog(path).value();
  const auto ear = std::make_shared<Ear>();
  log->logger().sinks().push_back(ear);
  log->Info("before");
  {
    const SmallFiles small(std::filesystem::file_size(path) + 10);
    for (int i = 0; i < 5; ++i) {
      log->Info("lost {}", i);
    }
  }
  log->Info("after");
  ASSERT_EQ(ear->lines.size(), 9u);
  EXPECT_NE(ear->lines[1].find("the log cannot be written"), std::string::npos) << ear->lines[1];
  EXPECT_NE(ear->lines[7].find("is written again, without 5 lines"), std::string::npos)
      << ear->lines[7];
  const std::string text = Read(path);
  EXPECT_NE(text.find("before\n"), std::string::npos);
  EXPECT_NE(text.find("\n5 lines could not be written here\n"), std::string::npos) << text;
  EXPECT_EQ(text.substr(text.size() - 6), "after\n");
  EXPECT_EQ(text.find("lost"), std::string::npos);
}

TEST(Log, AFileThatCannotBeOpenedIsAnErrorThatNamesIt) {
  const auto log = MakeLog("/proc/nowhere/log.txt");
  ASSERT_FALSE(log.ok());
  EXPECT_NE(log.message().find("/proc/nowhere/log.txt"), std::string::npos) << log.message();
}

}  // namespace
}  // namespace lararium
