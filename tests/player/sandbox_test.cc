#include "player/sandbox.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/prctl.h>
#include <sys/ptrace.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <functional>
#include <thread>

namespace lararium::player {
namespace {

// What a function returns in a process that has entered the sandbox; -1: it did not end by itself.
int Inside(const std::function<int()>& function) {
  const pid_t process = ::fork();
  if (process == 0) {
    if (!EnterSandbox().ok()) {
      std::_Exit(99);
    }
    std::_Exit(function());
  }
  int status = 0;
  ::waitpid(process, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

int ErrorOf(long result) { return result < 0 ? errno : 0; }

TEST(Sandbox, WhatAShowNeedsStillWorks) {
  EXPECT_EQ(Inside([] {
              int value = 0;
              std::thread([&value] { value = 7; }).join();
              const int file = ::open("/proc/self/status", O_RDONLY);
              const int local = ::socket(AF_UNIX, SOCK_STREAM, 0);
              return value == 7 && file >= 0 && local >= 0 ? 0 : 1;
            }),
            0);
}

TEST(Sandbox, NoOtherProgramsAndNoOtherProcesses) {
  EXPECT_EQ(Inside([] { return ErrorOf(::execl("/bin/true", "true", nullptr)); }), EPERM);
  EXPECT_EQ(Inside([] { return ErrorOf(::fork()); }), EPERM);
  EXPECT_EQ(Inside([] { return ErrorOf(::ptrace(PTRACE_TRACEME, 0, nullptr, nullptr)); }), EPERM);
}

TEST(Sandbox, NoNetwork) {
  EXPECT_EQ(Inside([] { return ErrorOf(::socket(AF_INET, SOCK_STREAM, 0)); }), EPERM);
  EXPECT_EQ(Inside([] { return ErrorOf(::socket(AF_INET6, SOCK_DGRAM, 0)); }), EPERM);
  EXPECT_EQ(Inside([] { return ErrorOf(::socket(AF_PACKET, SOCK_RAW, 0)); }), EPERM);
}

TEST(Sandbox, NoRightsOfFilesOrUsers) {
  EXPECT_EQ(Inside([] { return ErrorOf(::chmod("/tmp", 0777)); }), EPERM);
  EXPECT_EQ(Inside([] { return ErrorOf(::setuid(0)); }), EPERM);
}

TEST(Sandbox, ThreadsThatThereWereAreInItToo) {
  EXPECT_EQ(Inside([] {
              int code = -1;
              std::thread other([&code] { code = ErrorOf(::socket(AF_INET, SOCK_STREAM, 0)); });
              other.join();
              return code;
            }),
            EPERM);
}

}  // namespace
}  // namespace lararium::player
