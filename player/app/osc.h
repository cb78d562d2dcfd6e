#pragma once

// Receives messages of other programs for the drama's triggers: Open Sound Control 1.0 over UDP.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <span>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

#include "player/kiosk/listen_address.h"
#include "shared/core/log.h"
#include "shared/core/status.h"

namespace lararium::player {

// Returns the messages of a packet, also those inside bundles, as words of drama::Visitor::keys.
// Times of bundles are ignored: messages take effect when they arrive. An error rejects the whole
// packet: it is not valid OSC, nests bundles deeper than 4, or has a message with more than 8
// arguments, with an unsupported type (supported are numbers, texts, true, false and nil), or with
// more than 400 bytes.
Result<std::vector<std::string>> ParseOsc(std::span<const std::byte> packet);

// Listens on a thread of its own. It logs the first rejected packet and every hundredth.
class OscListener {
 public:
  // Fails if the port is in use. Borrows log.
  static Result<std::unique_ptr<OscListener>> Open(const ListenAddress& address, Log& log);
  ~OscListener();
  OscListener(const OscListener&) = delete;
  OscListener& operator=(const OscListener&) = delete;

  // Returns the messages since the last call, oldest first. If there are more than 256, the newest
  // are dropped.
  std::vector<std::string> Take();
  uint16_t port() const { return port_; }  // the actual port, also if port 0 (any) was requested

 private:
  OscListener(int socket, uint16_t port, Log& log);
  void Run(const std::stop_token& stop);
  void Refuse(const Status& status);

  int socket_;
  uint16_t port_;
  Log& log_;
  int64_t refused_ = 0;
  std::mutex mutex_;
  std::vector<std::string> words_;  // guarded by mutex_
  std::jthread thread_;
};

}  // namespace lararium::player
