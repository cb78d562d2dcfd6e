#include "player/kiosk/companion_process.h"

#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <utility>
#include <vector>

namespace lararium::player {
namespace {

constexpr int kPatienceMs = 1000;

void CloseAllBut(std::vector<int> kept) {
  std::sort(kept.begin(), kept.end());
  unsigned first = 3;
  for (const int file : kept) {
    const auto number = static_cast<unsigned>(file);
    if (number > first) {
      ::close_range(first, number - 1, 0);
    }
    first = std::max(first, number + 1);
  }
  ::close_range(first, ~0u, 0);
}

}  // namespace

Result<CompanionProcess> CompanionProcess::Start(const std::string& name,
                                                 std::span<const int> kept,
                                                 const std::function<int(int link)>& serve) {
  int ends[2];
  if (::socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends) != 0) {
    return Status::Error(name, std::strerror(errno));
  }
  const pid_t process = ::fork();
  if (process == 0) {
    // Signals to end the player reach the whole process group. This process ends after the player.
    std::signal(SIGINT, SIG_IGN);
    std::signal(SIGTERM, SIG_IGN);
    std::signal(SIGPIPE, SIG_IGN);
    ::prctl(PR_SET_NAME, name.c_str());
    std::vector<int> files(kept.begin(), kept.end());
    files.push_back(ends[1]);
    CloseAllBut(std::move(files));
    std::_Exit(serve(ends[1]));
  }
  ::close(ends[1]);
  if (process < 0) {
    ::close(ends[0]);
    return Status::Error(name, "cannot start a process for it");
  }
  return CompanionProcess(process, ends[0]);
}

CompanionProcess::CompanionProcess(CompanionProcess&& other) noexcept
    : process_(std::exchange(other.process_, -1)), link_(std::exchange(other.link_, -1)) {}

CompanionProcess::~CompanionProcess() {
  if (process_ < 0) {
    return;
  }
  ::close(link_);
  for (int waited = 0; waited < kPatienceMs; waited += 10) {
    if (::waitpid(process_, nullptr, WNOHANG) != 0) {
      return;
    }
    ::usleep(10'000);
  }
  ::kill(process_, SIGKILL);
  ::waitpid(process_, nullptr, 0);
}

}  // namespace lararium::player
