#include "tests/player/delay_proxy.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <deque>
#include <string>

#include "shared/core/check.h"
#include "shared/core/random.h"

namespace lararium::test {
namespace {

constexpr double kRepeatAfter = 0.2;

double Now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

int Socket() {
  const int file = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  const int on = 1;
  ::setsockopt(file, SOL_SOCKET, SO_REUSEADDR, &on, sizeof(on));
  ::setsockopt(file, IPPROTO_TCP, TCP_NODELAY, &on, sizeof(on));
  return file;
}

sockaddr_in Local(uint16_t port) {
  sockaddr_in address = {};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  address.sin_port = htons(port);
  return address;
}

// What is under way in one direction.
struct Queue {
  struct Piece {
    double due = 0.0;
    std::string bytes;
  };
  std::deque<Piece> pieces;
  double last = 0.0;
};

}  // namespace

class DelayProxy::Relay {
 public:
  Relay(uint16_t listen, uint16_t server, const Way& way, uint64_t seed)
      : server_(server), way_(way), random_(seed), listener_(Socket()) {
    const sockaddr_in address = Local(listen);
    CHECK(::bind(listener_, reinterpret_cast<const sockaddr*>(&address), sizeof(address)) == 0 &&
          ::listen(listener_, 4) == 0);
  }
  ~Relay() {
    Drop();
    ::close(listener_);
  }

  void Run(const std::stop_token& stop) {
    while (!stop.stop_requested()) {
      pollfd waiting[] = {{listener_, POLLIN, 0}, {ends_[0], POLLIN, 0}, {ends_[1], POLLIN, 0}};
      ::poll(waiting, 3, 1);
      if (cut_) {
        Drop();
      }
      if ((waiting[0].revents & POLLIN) != 0) {
        Accept();
        continue;
      }
      for (int from = 0; from < 2 && ends_[0] >= 0; ++from) {
        if (waiting[1 + from].revents != 0 && !Read(from)) {
          Drop();
        }
      }
      for (int from = 0; from < 2 && ends_[0] >= 0; ++from) {
        Write(from);
      }
    }
  }
  void Cut(bool cut) { cut_ = cut; }

 private:
  void Accept() {
    const int client = ::accept4(listener_, nullptr, nullptr, SOCK_CLOEXEC);
    const int server = Socket();
    const sockaddr_in address = Local(server_);
    if (cut_ ||
        ::connect(server, reinterpret_cast<const sockaddr*>(&address), sizeof(address)) != 0) {
      ::close(client);
      ::close(server);
      return;
    }
    Drop();
    const int on = 1;
    ::setsockopt(client, IPPROTO_TCP, TCP_NODELAY, &on, sizeof(on));
    ends_[0] = client;
    ends_[1] = server;
  }
  bool Read(int from) {
    std::string bytes(65536, '\0');
    const ssize_t size = ::recv(ends_[from], bytes.data(), bytes.size(), MSG_DONTWAIT);
    if (size <= 0) {
      return size < 0 && errno == EAGAIN;
    }
    bytes.resize(static_cast<size_t>(size));
    double due = Now() + way_.delay - way_.jitter * std::log(1.0 - random_.Uniform());
    while (random_.Uniform() < way_.loss) {
      due += kRepeatAfter + 2.0 * way_.delay;
    }
    Queue& queue = queues_[from];
    queue.last = std::max(queue.last, due);
    queue.pieces.push_back({queue.last, std::move(bytes)});
    return true;
  }
  void Write(int from) {
    Queue& queue = queues_[from];
    while (!queue.pieces.empty() && queue.pieces.front().due <= Now()) {
      const std::string bytes = std::move(queue.pieces.front().bytes);
      queue.pieces.pop_front();
      if (::send(ends_[1 - from], bytes.data(), bytes.size(), MSG_NOSIGNAL) < 0) {
        Drop();
        return;
      }
    }
  }
  void Drop() {
    for (int& end : ends_) {
      if (end >= 0) {
        ::close(end);
      }
      end = -1;
    }
    queues_[0] = queues_[1] = {};
  }

  uint16_t server_;
  Way way_;
  Random random_;
  int listener_;
  int ends_[2] = {-1, -1};  // Client and server.
  Queue queues_[2];         // Index by the end that the bytes come from.
  std::atomic<bool> cut_ = false;
};

DelayProxy::DelayProxy(uint16_t listen, uint16_t server, const Way& way, uint64_t seed)
    : relay_(std::make_unique<Relay>(listen, server, way, seed)),
      thread_([this](const std::stop_token& stop) { relay_->Run(stop); }) {}

DelayProxy::~DelayProxy() {
  thread_.request_stop();
  thread_.join();
}

void DelayProxy::Cut(bool cut) { relay_->Cut(cut); }

}  // namespace lararium::test
