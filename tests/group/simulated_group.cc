#include "tests/group/simulated_group.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace lararium::test {
namespace {

constexpr int64_t kFrame = 1'000'000 / 60;
constexpr int64_t kRepeatAfterLoss = 200'000;  // TCP's shortest, without the way.

}  // namespace

SimulatedGroup::SimulatedGroup(Network network, uint64_t seed)
    : network_(std::move(network)), random_(seed) {}

int64_t SimulatedGroup::OwnTime(const Device& device) const {
  return device.clock_offset + std::llround(static_cast<double>(now_) * (1.0 + device.clock_drift));
}

SimulatedGroup::Device& SimulatedGroup::Add(const std::string& kind, bool guide) {
  devices_.push_back(std::make_unique<Device>());
  Device& device = *devices_.back();
  const size_t index = devices_.size() - 1;
  device.name = kind + std::to_string(index);
  device.clock_drift = random_.Uniform(-50e-6, 50e-6);
  device.clock_offset = static_cast<int64_t>(1e9 * random_.Uniform(1.0, 100.0));
  device.visitor = index + 1;
  device.player = std::make_unique<GroupPlayer>(
      [this, &device] { return 1e-6 * static_cast<double>(OwnTime(device)); });
  device.boot = uint64_t{random_.Next()} << 32 | random_.Next();
  device.relay = std::make_unique<group::GroupRelay>(group::GroupMemberOptions{
      .name = device.name, .guide = guide, .boot = device.boot, .wall = [this] {
        return int64_t{1'800'000'000'000'000} + now_;
      }});
  return device;
}

void SimulatedGroup::Kill(size_t device, bool told) {
  devices_[device]->runs = false;
  for (size_t to = 0; told && to < size(); ++to) {
    Send(device, to, "");
  }
}

// The time at which a message has passed a device's connection, one way. Its messages stay in
// order.
int64_t SimulatedGroup::Pass(Device& device, size_t index, int way, int64_t time) {
  const int64_t shortest =
      network_.delays.empty() ? 0 : network_.delays[index % network_.delays.size()];
  const double more = -std::log(1.0 - random_.Uniform()) * static_cast<double>(network_.jitter);
  int64_t arrives = time + shortest + std::llround(more);
  while (random_.Uniform() < network_.loss) {
    arrives += kRepeatAfterLoss + 2 * shortest;
  }
  device.busy_until[way] = std::max(device.busy_until[way], arrives);
  return device.busy_until[way];
}

void SimulatedGroup::Send(size_t from, size_t to, const std::string& bytes) {
  Device& sender = *devices_[from];
  Device& receiver = *devices_[to];
  if (!broker_ || sender.side != receiver.side || !receiver.runs || from == to) {
    return;
  }
  ++messages_;
  bytes_ += static_cast<int64_t>(bytes.size());
  flying_.emplace(Pass(sender, from, 0, now_), Flying{false, to, from, bytes});
}

void SimulatedGroup::Step() {
  now_ += kFrame;
  while (!flying_.empty() && flying_.begin()->first <= now_) {
    const auto first = flying_.begin();
    const int64_t arrives = first->first;
    Flying message = flying_.extract(first).mapped();
    Device& to = *devices_[message.to];
    const Device& from = *devices_[message.from];
    if (!to.runs || !broker_ || to.side != from.side) {
      continue;
    }
    if (!std::exchange(message.at_broker, true)) {
      const int64_t time = Pass(to, message.to, 1, arrives);
      flying_.emplace(time, std::move(message));
      continue;
    }
    if (message.bytes.empty()) {
      to.relay->member().SetGone(from.name);
      continue;
    }
    // A message is taken when it comes, not at the next frame.
    const int64_t late = now_ - arrives;
    EXPECT_TRUE(to.relay->TakeMessage(from.name, message.bytes, OwnTime(to) - late).ok());
  }
  for (size_t i = 0; i < size(); ++i) {
    if (devices_[i]->runs) {
      Frame(*devices_[i], i);
    }
  }
}

void SimulatedGroup::Frame(Device& device, size_t index) {
  const int64_t now = OwnTime(device);
  device.relay->Step(now);
  for (const group::GroupMember::Outgoing& message : device.relay->member().TakeOutgoing()) {
    for (size_t to = 0; to < size(); ++to) {
      if (message.to.empty() || devices_[to]->name == message.to) {
        Send(index, to, message.bytes);
      }
    }
  }
  for (const std::string& message : device.relay->TakeForPlayer(now)) {
    device.player->feed().Take(message);
  }
  drama::Visitor visitor =
      device.visitor == 0 ? drama::Visitor() : WanderingVisitor(device.visitor, this->now());
  visitor.keys = std::exchange(device.keys, "");
  device.player->Frame(visitor);
  device.relay->TakeOwn(device.player->TakeOwn(), now);
}

double SimulatedGroup::Spread() const {
  double least = 1e9;
  double most = -1e9;
  for (const auto& device : devices_) {
    if (device->runs) {
      least = std::min(least, device->seconds());
      most = std::max(most, device->seconds());
    }
  }
  return most - least;
}

ComparedStates SimulatedGroup::Compare(double from) const {
  std::vector<const GroupPlayer*> players;
  for (const auto& device : devices_) {
    players.push_back(device->player.get());
  }
  return test::Compare(players, from);
}

}  // namespace lararium::test
