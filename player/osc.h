#pragma once

// Messages of other programs: Open Sound Control 1.0 over UDP, for the drama's triggers.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <span>
#include <stop_token>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "player/listen_address.h"
#include "shared/core/log.h"
#include "shared/core/status.h"

namespace lararium::player {

// The messages of a packet, bundles taken apart, as words of drama::Visitor::keys. Their
// times are ignored: they happen when they come. An error refuses the packet as a whole: it
// is not as OSC says, nests bundles deeper than 4, or a message has more than 8 arguments,
// another type of argument (numbers, texts, true, false and nothing are taken) or more than
// 400 bytes.
Result<std::vector<std::string>> ParseOsc(std::span<const std::byte> packet);

// Listens on a thread of its own. The log has a line for the first packet that is refused
// and for each hundredth.
class OscListener {
 public:
  // Fails where the port is taken. Borrows log.
  static Result<std::unique_ptr<OscListener>> Open(const ListenAddress& address, Log& log);
  ~OscListener();
  OscListener(const OscListener&) = delete;
  OscListener& operator=(const OscListener&) = delete;

  // Those that came since the last call, oldest first; of more than 256 the newest are lost.
  std::vector<std::string> Take();
  uint16_t port() const { return port_; }  // also where any was asked for, by 0

 private:
  OscListener(int socket, uint16_t port, Log& log);
  void Run(const std::stop_token& stop);
  void Refuse(const Status& status);

  int socket_;
  uint16_t port_;
  Log& log_;
  int64_t refused_ = 0;
  std::mutex mutex_;
  std::vector<std::string> words_;  // with the mutex
  std::jthread thread_;
};

}  // namespace lararium::player
