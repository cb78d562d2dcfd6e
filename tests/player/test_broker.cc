#include "tests/player/test_broker.h"

#include <arpa/inet.h>
#include <fcntl.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <fstream>
#include <thread>

#include "shared/core/file.h"

namespace lararium::test {
namespace {

constexpr char kProgram[] = "/usr/sbin/mosquitto";

sockaddr_in LocalAddress(uint16_t port) {
  sockaddr_in address = {};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  address.sin_port = htons(port);
  return address;
}

bool Listens(uint16_t port) {
  const int file = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  const sockaddr_in address = LocalAddress(port);
  const bool connected =
      ::connect(file, reinterpret_cast<const sockaddr*>(&address), sizeof(address)) == 0;
  ::close(file);
  return connected;
}

}  // namespace

bool Soon(const std::function<bool()>& holds) {
  for (int i = 0; i < 2000; ++i) {
    if (holds()) {
      return true;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return false;
}

uint16_t FreePort() {
  const int file = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  sockaddr_in address = LocalAddress(0);
  socklen_t size = sizeof(address);
  ::bind(file, reinterpret_cast<const sockaddr*>(&address), size);
  ::getsockname(file, reinterpret_cast<sockaddr*>(&address), &size);
  ::close(file);
  return ntohs(address.sin_port);
}

bool TestBroker::installed() { return FileExists(kProgram); }

// Debian's own configuration includes files of a folder in the same way.
void TestBroker::Start(const std::string& files, uint16_t port) {
  const std::filesystem::path main = folder_ / "mosquitto.conf";
  std::ofstream(main) << (::geteuid() == 0 ? "user root\n" : "") << "persistence false\n"
                      << "log_dest file " << (folder_ / "broker.log").string() << "\n"
                      << "include_dir " << files << "\n";
  process_ = ::fork();
  if (process_ == 0) {
    const int nowhere = ::open("/dev/null", O_WRONLY);
    ::dup2(nowhere, STDERR_FILENO);
    ::execl(kProgram, kProgram, "-c", main.c_str(), nullptr);
    std::_Exit(127);
  }
  ASSERT_TRUE(Soon([port] { return Listens(port); })) << log();
}

void TestBroker::Kill() {
  if (process_ > 0) {
    ::kill(process_, SIGKILL);
    ::waitpid(process_, nullptr, 0);
    process_ = -1;
  }
}

std::string TestBroker::log() const {
  const auto text = ReadText(folder_ / "broker.log");
  return text.ok() ? *text : "";
}

}  // namespace lararium::test
