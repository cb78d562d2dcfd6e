#include "player/kiosk/watchdog.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <optional>
#include <string>
#include <string_view>

#include "shared/core/number_text.h"

namespace lararium::player {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int64_t kBeatMilliseconds = 200;
constexpr char kBeat = 'b';
constexpr char kBeatBeforeLongWork = 'w';
constexpr int kPollMilliseconds = 50;

volatile std::sig_atomic_t g_end_asked = 0;

void AskForEnd(int /*signal*/) { g_end_asked = 1; }

double SecondsSince(Clock::time_point time) {
  return std::chrono::duration<double>(Clock::now() - time).count();
}

// Does the same as sd_notify(3); does nothing if systemd does not listen.
void TellSystemd(std::string_view message) {
  const char* path = std::getenv("NOTIFY_SOCKET");
  sockaddr_un address = {};
  if (path == nullptr || path[0] == '\0' || std::strlen(path) >= sizeof(address.sun_path)) {
    return;
  }
  address.sun_family = AF_UNIX;
  std::memcpy(address.sun_path, path, std::strlen(path));
  if (path[0] == '@') {
    address.sun_path[0] = '\0';
  }
  const int descriptor = ::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  if (descriptor < 0) {
    return;
  }
  const auto size = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + std::strlen(path));
  (void)::sendto(descriptor, message.data(), message.size(), MSG_NOSIGNAL | MSG_DONTWAIT,
                 reinterpret_cast<const sockaddr*>(&address), size);
  ::close(descriptor);
}

// One child from its start to its end.
class Child {
 public:
  static constexpr int kNone = -1;

  // Does not return in the child.
  bool Start(const std::function<int(const ChildStart&, Heartbeat&)>& run,
             const ChildStart& start) {
    int ends[2];
    if (::pipe2(ends, O_CLOEXEC | O_NONBLOCK) != 0) {
      return false;
    }
    process_ = ::fork();
    if (process_ == 0) {
      ::prctl(PR_SET_PDEATHSIG, SIGTERM);  // the child ends when the watchdog has died
      ::close(ends[0]);
      Heartbeat heartbeat(ends[1]);
      std::_Exit(run(start, heartbeat));
    }
    ::close(ends[1]);
    beats_ = ends[0];
    last_beat_ = Clock::now();
    if (process_ < 0) {
      ::close(beats_);
      return false;
    }
    return true;
  }

  // True if the child has beaten since the last call.
  bool Beats() {
    pollfd wanted = {beats_, POLLIN, 0};
    if (::poll(&wanted, 1, kPollMilliseconds) <= 0 || (wanted.revents & POLLIN) == 0) {
      if ((wanted.revents & POLLHUP) != 0) {
        ::usleep(kPollMilliseconds * 1000);  // the child is about to end
      }
      return false;
    }
    char beats[64];
    bool any = false;
    for (ssize_t count = 0; (count = ::read(beats_, beats, sizeof(beats))) > 0; any = true) {
      works_long_ = beats[count - 1] == kBeatBeforeLongWork;
      if (!first_beat_ && std::find(beats, beats + count, kBeat) != beats + count) {
        first_beat_ = Clock::now();
      }
    }
    if (any) {
      last_beat_ = Clock::now();
    }
    return any;
  }

  // Returns whether the child has ended. code: its exit code, or 128 + its signal.
  bool Ended(int& code) {
    int status = 0;
    if (::waitpid(process_, &status, WNOHANG) != process_) {
      return false;
    }
    code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    ::close(beats_);
    return true;
  }

  // Asks the child to end, and kills it if it does not within grace_seconds.
  int End(double grace_seconds) {
    ::kill(process_, SIGTERM);
    const Clock::time_point asked = Clock::now();
    int code = 0;
    while (SecondsSince(asked) < grace_seconds) {
      if (Ended(code)) {
        return code;
      }
      ::usleep(10'000);
    }
    ::kill(process_, SIGKILL);
    while (!Ended(code)) {
      ::usleep(1'000);
    }
    return code;
  }

  bool Hangs(const WatchdogOptions& options) const {
    return SecondsSince(last_beat_) >
           (works_long_ ? options.start_seconds : options.silent_seconds);
  }
  // Seconds since the first beat after the preparation; 0 if there was none.
  double age() const { return first_beat_ ? SecondsSince(*first_beat_) : 0.0; }

 private:
  pid_t process_ = kNone;
  int beats_ = kNone;
  bool works_long_ = true;  // the child has announced long work, or has just started
  std::optional<Clock::time_point> first_beat_;
  Clock::time_point last_beat_;
};

// Waits until a child has ended or hangs. Returns its exit code; 0 if this process was asked to
// end.
int Watch(Child& child, const WatchdogOptions& options, Log& log, bool& ready) {
  int code = 0;
  while (true) {
    if (child.Beats()) {
      TellSystemd(ready ? "WATCHDOG=1" : "READY=1\nWATCHDOG=1");
      ready = true;
    }
    if (child.Ended(code)) {
      return g_end_asked != 0 ? 0 : code;
    }
    if (g_end_asked != 0) {
      child.End(options.grace_seconds);
      return 0;
    }
    if (child.Hangs(options)) {
      log.Error("the show hangs; it is begun again");
      // No grace time: a child that hangs cannot save anything more.
      child.End(0.0);
      return 128 + SIGKILL;
    }
  }
}

void Pause(double seconds) {
  const Clock::time_point begin = Clock::now();
  while (g_end_asked == 0 && SecondsSince(begin) < seconds) {
    ::usleep(20'000);
    TellSystemd("WATCHDOG=1");
  }
}

}  // namespace

void Heartbeat::Beat() {
  if (descriptor_ < 0) {
    return;
  }
  const int64_t now =
      std::chrono::duration_cast<std::chrono::milliseconds>(Clock::now().time_since_epoch())
          .count();
  if (now - last_ms_ >= kBeatMilliseconds) {
    last_ms_ = now;
    Say(kBeat);
  }
}

void Heartbeat::BeatBeforeLongWork() {
  if (descriptor_ >= 0) {
    last_ms_ = 0;  // the next beat is sent at once and ends the long work
    Say(kBeatBeforeLongWork);
  }
}

void Heartbeat::Say(char beat) {
  (void)!::write(descriptor_, &beat, 1);  // errors are ignored: a full pipe counts as a beat too
}

int Supervise(const std::function<int(const ChildStart&, Heartbeat&)>& child,
              const WatchdogOptions& options,
              Log& log) {
  std::signal(SIGINT, AskForEnd);
  std::signal(SIGTERM, AskForEnd);
  std::signal(SIGPIPE, SIG_IGN);
  ChildStart start;
  double pause = options.first_pause_seconds;
  bool ready = false;
  while (true) {
    Child process;
    if (!process.Start(child, start)) {
      log.Error("no process can be started; trying again");
      Pause(1.0);
      continue;
    }
    WatchdogOptions patient = options;
    patient.silent_seconds = std::min(std::ldexp(options.silent_seconds, start.failed_starts),
                                      std::max(options.silent_seconds, options.start_seconds));
    const int code = Watch(process, patient, log, ready);
    if (g_end_asked != 0 || code == 0 || code == kUsageError) {
      TellSystemd("STOPPING=1");
      return code;
    }
    if (code == kStartAgain) {
      start.failed_starts = 0;
      ++start.number;
      continue;
    }
    const bool lived = process.age() >= options.stable_seconds;
    start.failed_starts = lived ? 0 : start.failed_starts + 1;
    pause = start.failed_starts <= 1
                ? options.first_pause_seconds
                : std::min(std::max(2.0 * pause, 0.25), options.longest_pause_seconds);
    log.Error("the show ended with {}; it is begun again{}", code,
              pause > 0.0 ? " in " + FormatNumber(pause) + " s" : "");
    ++start.number;
    Pause(pause);
    if (g_end_asked != 0) {
      return 0;
    }
  }
}

}  // namespace lararium::player
