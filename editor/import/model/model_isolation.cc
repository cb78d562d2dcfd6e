#include "editor/import/model/model_isolation.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <fstream>
#include <thread>

#include "shared/core/fork.h"

namespace lararium::import {
namespace {

constexpr char kDone = 'D', kFailed = 'F';
constexpr size_t kMaxMessageBytes = size_t{2} << 30;

#ifdef LARARIUM_SANITIZED
constexpr bool kSanitized = true;  // A limit would count the shadow memory of sanitizers.
#else
constexpr bool kSanitized = false;
#endif

class Descriptor {
 public:
  explicit Descriptor(int fd) : fd_(fd) {}
  ~Descriptor() {
    if (fd_ >= 0) {
      close(fd_);
    }
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int get() const { return fd_; }

 private:
  int fd_;
};

size_t AddressSpaceBytes() {
  std::ifstream statm("/proc/self/statm");
  size_t pages = 0;
  statm >> pages;
  return pages * static_cast<size_t>(sysconf(_SC_PAGESIZE));
}

void Limit(const IsolationLimits& limits) {
  const rlimit none = {0, 0};
  setrlimit(RLIMIT_CORE, &none);
  const rlimit cpu = {limits.cpu_seconds, limits.cpu_seconds + 1};
  setrlimit(RLIMIT_CPU, &cpu);
  if (!kSanitized) {
    const rlim_t bytes = AddressSpaceBytes() + limits.memory_bytes;
    const rlimit memory = {bytes, bytes};
    setrlimit(RLIMIT_AS, &memory);
    // The output of a library that aborts should not reach the user's terminal.
    const int nowhere = open("/dev/null", O_WRONLY | O_CLOEXEC);
    dup2(nowhere, STDERR_FILENO);
    dup2(nowhere, STDOUT_FILENO);
  }
}

bool WriteAll(int fd, const void* data, size_t size) {
  const auto* bytes = static_cast<const char*>(data);
  while (size > 0) {
    const ssize_t written = write(fd, bytes, size);
    if (written < 0 && errno == EINTR) {
      continue;
    }
    if (written <= 0) {
      return false;
    }
    bytes += written;
    size -= static_cast<size_t>(written);
  }
  return true;
}

// Never returns; skips the destructors and exit handlers of the parent.
[[noreturn]] void RunChild(int fd,
                           const std::function<Result<std::vector<std::byte>>()>& work,
                           const IsolationLimits& limits) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  for (const int signal : {SIGINT, SIGTERM, SIGSEGV, SIGABRT, SIGFPE, SIGBUS, SIGILL, SIGXCPU}) {
    if (!kSanitized || signal == SIGINT || signal == SIGTERM) {
      std::signal(signal, SIG_DFL);
    }
  }
  Limit(limits);
  bool written = false;
  try {
    const auto result = work();
    if (result.ok()) {
      written = WriteAll(fd, &kDone, 1) && WriteAll(fd, result->data(), result->size());
    } else {
      const std::string& message = result.message();
      written = WriteAll(fd, &kFailed, 1) && WriteAll(fd, message.data(), message.size());
    }
  } catch (...) {
    written = false;
  }
  _exit(written ? 0 : 1);
}

// Gets the exit status of the child; false if it took too long and was killed.
bool Wait(pid_t child, unsigned seconds, int& status) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(seconds);
  auto pause = std::chrono::microseconds(500);
  while (true) {
    const pid_t ended = waitpid(child, &status, WNOHANG);
    if (ended == child) {
      return true;
    }
    if ((ended < 0 && errno != EINTR) || std::chrono::steady_clock::now() > end) {
      kill(child, SIGKILL);
      waitpid(child, &status, 0);
      return false;
    }
    std::this_thread::sleep_for(pause);
    pause = std::min(2 * pause, std::chrono::microseconds(20'000));
  }
}

Result<std::vector<std::byte>> ReadAll(int fd, const std::string& where) {
  const off_t size = lseek(fd, 0, SEEK_END);
  if (size < 1 || static_cast<size_t>(size) > kMaxMessageBytes) {
    return Status::Error(where, "is too large once it is read", "simplify the model");
  }
  std::vector<std::byte> bytes(static_cast<size_t>(size));
  size_t at = 0;
  while (at < bytes.size()) {
    const ssize_t got = pread(fd, bytes.data() + at, bytes.size() - at, static_cast<off_t>(at));
    if (got < 0 && errno == EINTR) {
      continue;
    }
    if (got <= 0) {
      return Status::Error(where, "the result of its reader was lost");
    }
    at += static_cast<size_t>(got);
  }
  return bytes;
}

Status Crashed(const std::string& where, int status) {
  const bool time = WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU;
  const bool memory = WIFEXITED(status);  // An uncaught exception: out of memory.
  return Status::Error(where,
                       time     ? "reading it takes too long"
                       : memory ? "reading it takes too much memory"
                                : "the library that reads it crashed: the file is damaged",
                       "export it again, best as glTF 2.0 binary (.glb)");
}

}  // namespace

Result<std::vector<std::byte>> RunInChild(
    const std::string& where,
    const std::function<Result<std::vector<std::byte>>()>& work,
    const IsolationLimits& limits) {
  const Descriptor message(memfd_create("lararium-import", MFD_CLOEXEC));
  if (message.get() < 0) {
    return Status::Error(where, std::string("no memory to read it: ") + std::strerror(errno));
  }
  const pid_t child = ForkApart();
  if (child < 0) {
    return Status::Error(where, std::string("cannot start its reader: ") + std::strerror(errno));
  }
  if (child == 0) {
    RunChild(message.get(), work, limits);
  }
  int status = 0;
  if (!Wait(child, limits.wall_seconds, status)) {
    return Status::Error(where, "reading it takes too long", "simplify the model");
  }
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) {
    return Crashed(where, status);
  }
  LARARIUM_ASSIGN_OR_RETURN(std::vector<std::byte> bytes, ReadAll(message.get(), where));
  const bool done = bytes[0] == static_cast<std::byte>(kDone);
  bytes.erase(bytes.begin());
  if (!done) {
    // The text already begins with `where`.
    const std::string text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    return Status::Error(where,
                         text.starts_with(where + ": ") ? text.substr(where.size() + 2) : text);
  }
  return bytes;
}

}  // namespace lararium::import
