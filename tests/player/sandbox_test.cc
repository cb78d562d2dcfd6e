#include "player/kiosk/sandbox.h"

#include <arpa/inet.h>
#include <fcntl.h>
#include <gtest/gtest.h>
#include <linux/landlock.h>
#include <netinet/in.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/ptrace.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <filesystem>
#include <functional>
#include <thread>

namespace lararium::player {
namespace {

// Runs a function in a process that has entered a sandbox. Returns its result; -1: the process was
// killed.
int InsideOf(const std::function<Status()>& enter, const std::function<int()>& function) {
  const pid_t process = ::fork();
  if (process == 0) {
    if (!enter().ok()) {
      std::_Exit(99);
    }
    std::_Exit(function());
  }
  int status = 0;
  ::waitpid(process, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

int Inside(const std::function<int()>& function) { return InsideOf(EnterSandbox, function); }

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

TEST(OpeningSandbox, DriversMayStartProgramsAndHaveSockets) {
  EXPECT_EQ(InsideOf(EnterOpeningSandbox,
                     [] {
                       const int socket = ::socket(AF_INET, SOCK_DGRAM, 0);
                       return socket >= 0 ? ErrorOf(::execl("/bin/true", "true", nullptr)) : 1;
                     }),
            0);
}

TEST(OpeningSandbox, WhatNobodyNeedsIsGoneBeforeTheShowIsRead) {
  const auto inside = [](const std::function<int()>& function) {
    return InsideOf(EnterOpeningSandbox, function);
  };
  EXPECT_EQ(inside([] { return ErrorOf(::ptrace(PTRACE_TRACEME, 0, nullptr, nullptr)); }), EPERM);
  EXPECT_EQ(inside([] { return ErrorOf(::setuid(0)); }), EPERM);
  EXPECT_EQ(inside([] { return ErrorOf(::unshare(0)); }), EPERM);
}

TEST(OpeningSandbox, TheOneForPlayingIsEnteredAfterIt) {
  EXPECT_EQ(InsideOf(
                [] {
                  const Status opening = EnterOpeningSandbox();
                  return opening.ok() ? EnterSandbox() : opening;
                },
                [] { return ErrorOf(::socket(AF_INET, SOCK_STREAM, 0)); }),
            EPERM);
}

TEST(Sandbox, NobodyIsLetInWhereNoPageIsAskedFor) {
  const int listening = ::socket(AF_INET, SOCK_STREAM, 0);
  ASSERT_EQ(::listen(listening, 1), 0);
  EXPECT_EQ(Inside([=] { return ErrorOf(::listen(listening, 1)); }), EPERM);
  EXPECT_EQ(Inside([=] { return ErrorOf(::accept(listening, nullptr, nullptr)); }), EPERM);
  ::close(listening);
}

// A socket that listens on a port of this machine, and a socket that connects to it.
class PageSandbox : public ::testing::Test {
 protected:
  void SetUp() override {
    address_.sin_family = AF_INET;
    address_.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof(address_);
    ASSERT_EQ(::bind(listening_, Address(), size), 0);
    ASSERT_EQ(::listen(listening_, 4), 0);
    ASSERT_EQ(::getsockname(listening_, reinterpret_cast<sockaddr*>(&address_), &size), 0);
    ASSERT_EQ(::connect(caller_, Address(), size), 0);
  }
  void TearDown() override {
    ::close(listening_);
    ::close(caller_);
  }
  const sockaddr* Address() const { return reinterpret_cast<const sockaddr*>(&address_); }
  int InPage(const std::function<int()>& function) const {
    return InsideOf([this] { return EnterPageSandbox(listening_); }, function);
  }

  int listening_ = ::socket(AF_INET, SOCK_STREAM, 0);
  int caller_ = ::socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in address_ = {};
};

TEST_F(PageSandbox, WhoHasCalledIsAnswered) {
  EXPECT_EQ(InPage([this] {
              const int visitor = ::accept(listening_, nullptr, nullptr);
              return visitor >= 0 && ::send(visitor, "x", 1, 0) == 1 ? 0 : 1;
            }),
            0);
  char got = 0;
  EXPECT_EQ(::recv(caller_, &got, 1, 0), 1);
  EXPECT_EQ(got, 'x');
}

TEST_F(PageSandbox, NobodyIsCalled) {
  EXPECT_EQ(InPage([] { return ErrorOf(::socket(AF_INET, SOCK_STREAM, 0)); }), EPERM);
  EXPECT_EQ(InPage([] { return ErrorOf(::socket(AF_UNIX, SOCK_STREAM, 0)); }), EPERM);
  EXPECT_EQ(InPage([this] { return ErrorOf(::connect(caller_, Address(), sizeof(address_))); }),
            EPERM);
  EXPECT_EQ(
      InPage([this] {
        ::shutdown(listening_, SHUT_RD);
        return ErrorOf(::sendto(listening_, "x", 1, MSG_FASTOPEN, Address(), sizeof(address_)));
      }),
      EPERM);
  EXPECT_EQ(InPage([this] { return ErrorOf(::accept(caller_, nullptr, nullptr)); }), EPERM)
      << "only the socket that it was given listens";
  EXPECT_EQ(InPage([this] { return ErrorOf(::bind(caller_, Address(), sizeof(address_))); }),
            EPERM);
}

TEST_F(PageSandbox, NoFileIsOpenedAndNothingElseIsRun) {
  EXPECT_EQ(InPage([] { return ErrorOf(::open("/etc/hostname", O_RDONLY)); }), EPERM);
  EXPECT_EQ(InPage([] { return ErrorOf(::unlink("/tmp/lararium_no_such_file")); }), EPERM);
  EXPECT_EQ(InPage([] { return ErrorOf(::execl("/bin/true", "true", nullptr)); }), EPERM);
  EXPECT_EQ(InPage([] { return ErrorOf(::fork()); }), EPERM);
  EXPECT_EQ(InPage([] { return ErrorOf(::kill(::getppid(), 0)); }), EPERM);
  EXPECT_EQ(InPage([] {
              void* memory =
                  ::mmap(nullptr, 4096, PROT_READ | PROT_EXEC, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
              return memory == MAP_FAILED ? errno : 0;
            }),
            EPERM);
}

// The sandbox of a process that connects to a port of this machine.
class ClientSandbox : public PageSandbox {
 protected:
  int InClient(const std::function<int()>& function) const {
    return InsideOf(
        [this] {
          const std::filesystem::path files[] = {"/proc/self/status"};
          return EnterClientSandbox(files, ntohs(address_.sin_port));
        },
        function);
  }
};

TEST_F(ClientSandbox, TheServerIsCalledAndTheFilesAreRead) {
  EXPECT_EQ(InClient([this] {
              const int socket = ::socket(AF_INET, SOCK_STREAM, 0);
              return ErrorOf(::connect(socket, Address(), sizeof(address_)));
            }),
            0);
  EXPECT_EQ(InClient([] { return ErrorOf(::open("/etc/hosts", O_RDONLY)); }), 0);
}

TEST_F(ClientSandbox, NoOtherFileIsReadAndNoneIsWritten) {
  EXPECT_EQ(InClient([] { return ErrorOf(::open("/usr/bin/env", O_RDONLY)); }), EACCES);
  EXPECT_EQ(InClient([] { return ErrorOf(::open("/etc/hosts", O_RDWR)); }), EPERM);
  EXPECT_EQ(InClient([] {
              return ErrorOf(::open("/tmp/lararium_no_such_file", O_RDONLY | O_CREAT, 0600));
            }),
            EPERM);
  EXPECT_EQ(InClient([] { return ErrorOf(::unlink("/tmp/lararium_no_such_file")); }), EPERM);
}

TEST_F(ClientSandbox, ProgramsOfThisMachineAreNotReachedAndNobodyCalls) {
  EXPECT_EQ(InClient([] { return ErrorOf(::socket(AF_UNIX, SOCK_STREAM, 0)); }), EPERM);
  EXPECT_EQ(InClient([this] { return ErrorOf(::accept(listening_, nullptr, nullptr)); }), EPERM);
  EXPECT_EQ(InClient([] { return ErrorOf(::execl("/bin/true", "true", nullptr)); }), EPERM);
  EXPECT_EQ(InClient([] { return ErrorOf(::fork()); }), EPERM);
  EXPECT_EQ(InClient([] { return ErrorOf(::kill(::getppid(), 0)); }), EPERM);
}

TEST_F(ClientSandbox, OtherPortsAreNotCalledWhereTheKernelLimitsThem) {
  constexpr int kWithPorts = 4;
  if (::syscall(SYS_landlock_create_ruleset, nullptr, 0, LANDLOCK_CREATE_RULESET_VERSION) <
      kWithPorts) {
    GTEST_SKIP() << "needs Linux 6.7 with Landlock";
  }
  EXPECT_EQ(
      InClient([this] {
        sockaddr_in other = address_;
        other.sin_port = htons(static_cast<uint16_t>(ntohs(address_.sin_port) ^ 1));
        const int socket = ::socket(AF_INET, SOCK_STREAM, 0);
        return ErrorOf(::connect(socket, reinterpret_cast<const sockaddr*>(&other), sizeof(other)));
      }),
      EACCES);
}

}  // namespace
}  // namespace lararium::player
