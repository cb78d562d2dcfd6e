#pragma once

// Devices of a group that play one drama, in simulated time, over a simulated broker with delays,
// losses, splits and failures. Everything but sockets is as in a player.

#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "shared/core/random.h"
#include "shared/group/group_relay.h"
#include "tests/group/group_player.h"

namespace lararium::test {

class SimulatedGroup {
 public:
  struct Network {
    // The delay of a message from a device to the broker or back, microseconds: the shortest, and
    // the mean of what is added.
    std::vector<int64_t> delays;  // Device i has delays[i % size].
    int64_t jitter = 0;
    double loss = 0.0;  // A lost message is sent again; the following ones wait for it.
  };
  struct Device {
    std::string name;
    int side = 0;  // Devices on another side hear nothing of each other.
    bool runs = true;
    bool connected = true;
    double clock_drift = 0.0;  // The device's clock is faster by this share.
    int64_t clock_offset = 0;  // Microseconds.
    uint64_t boot = 0;
    uint64_t visitor = 0;  // Seed of WanderingVisitor(); 0: the device has no visitor.
    std::string keys;      // Are pressed at the next frame.
    std::unique_ptr<GroupPlayer> player;
    std::unique_ptr<group::GroupRelay> relay;
    int64_t busy_until[2] = {0, 0};  // Times at which the ways to and from the broker are free.

    double seconds() const { return player->seconds(); }
    const group::GroupMember& member() const { return std::as_const(*relay).member(); }
    size_t log_size() const { return member().log().size(); }
  };

  SimulatedGroup(Network network, uint64_t seed);

  // Switches a device on, now. Devices are numbered in this order.
  Device& Add(bool guide = false) { return Add("tablet-", guide); }
  Device& AddPage() { return Add(std::string(group::kPage), false); }
  // Ends a device. told: the broker notices at once.
  void Kill(size_t device, bool told);
  // Without the broker, nothing gets through.
  void SetBroker(bool runs) { broker_ = runs; }
  // Plays on. each: called for each 60th of a second.
  template <typename Each>
  void Play(double seconds, const Each& each) {
    for (const int64_t end = now_ + static_cast<int64_t>(1e6 * seconds); now_ < end;) {
      Step();
      each();
    }
  }
  void Play(double seconds) {
    Play(seconds, [] {});
  }

  Device& device(size_t i) { return *devices_[i]; }
  size_t size() const { return devices_.size(); }
  double now() const { return 1e-6 * static_cast<double>(now_); }
  // The largest difference of the drama's time between devices that run, seconds.
  double Spread() const;
  ComparedStates Compare(double from = 0.0) const;
  int64_t bytes_sent() const { return bytes_; }
  int64_t messages_sent() const { return messages_; }

 private:
  struct Flying {
    bool at_broker = false;  // The message has come to the broker.
    size_t to = 0;
    size_t from = 0;
    std::string bytes;  // Empty: the broker says that `from` is gone.
  };

  Device& Add(const std::string& kind, bool guide);
  int64_t OwnTime(const Device& device) const;
  void Step();
  void Frame(Device& device, size_t index);
  void Send(size_t from, size_t to, const std::string& bytes);
  int64_t Pass(Device& device, size_t index, int way, int64_t time);

  Network network_;
  Random random_;
  std::vector<std::unique_ptr<Device>> devices_;
  std::multimap<int64_t, Flying> flying_;
  bool broker_ = true;
  int64_t now_ = 0;
  int64_t bytes_ = 0;
  int64_t messages_ = 0;
};

}  // namespace lararium::test
