#pragma once

// A way to a TCP server that takes time: a stand-in for a bad wireless network.

#include <cstdint>
#include <memory>
#include <thread>

namespace lararium::test {

class DelayProxy {
 public:
  struct Way {
    double delay = 0.0;   // Seconds, each way.
    double jitter = 0.0;  // Mean of an exponential time that is added.
    // Share of pieces that are lost: they and what follows come 0.2 s and a round trip later, as
    // TCP repeats them.
    double loss = 0.0;
  };

  // Listens at a port of this machine and connects to another one.
  DelayProxy(uint16_t listen, uint16_t server, const Way& way, uint64_t seed);
  ~DelayProxy();
  DelayProxy(const DelayProxy&) = delete;
  DelayProxy& operator=(const DelayProxy&) = delete;

  // Drops the connection, and refuses others until it is called with false.
  void Cut(bool cut);

 private:
  class Relay;
  std::unique_ptr<Relay> relay_;
  std::jthread thread_;
};

}  // namespace lararium::test
