// A group over a real broker and bad networks, in real time.

#include <gmock/gmock.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <memory>
#include <thread>
#include <vector>

#include "player/fleet/fleet_client.h"
#include "player/fleet/fleet_setup.h"
#include "player/staff/staff_link.h"
#include "tests/group/group_player.h"
#include "tests/player/delay_proxy.h"
#include "tests/player/test_broker.h"
#include "tests/support/test_files.h"
#include "tests/support/thorough.h"

namespace lararium::player {
namespace {

// How long the devices play before anything fails.
const double kSeconds = test::IsThorough() ? 600.0 : 20.0;

double Steady() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

// One device: the client of its link and the link's end in the player, each with its thread, and a
// player that the test's thread runs.
class NetworkDevice {
 public:
  NetworkDevice(const FleetOptions& options, size_t number, Log& log)
      : number_(number), player_(Steady) {
    EXPECT_EQ(::socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends_), 0);
    auto client = FleetClient::Create(options, ends_[1]);
    EXPECT_TRUE(client.ok()) << client.message();
    client_ = *std::move(client);
    link_ = std::make_unique<StaffLink>(
        StaffLinks{.fleet = ends_[0]}, log,
        GroupPort{[this] { return player_.TakeOwn(); },
                  [this](std::string_view news) { player_.feed().Take(news); }});
    thread_ = std::thread([this] { client_->Run(); });
  }
  ~NetworkDevice() { End(); }
  NetworkDevice(const NetworkDevice&) = delete;
  NetworkDevice& operator=(const NetworkDevice&) = delete;

  // The player goes, and its link with it.
  void End() {
    if (thread_.joinable()) {
      link_.reset();
      ::shutdown(ends_[0], SHUT_RDWR);
      thread_.join();
      ::close(ends_[0]);
      ::close(ends_[1]);
    }
  }
  bool runs() const { return thread_.joinable(); }
  void Frame(double seconds, const std::string& keys) {
    drama::Visitor visitor = test::WanderingVisitor(number_ + 1, seconds);
    visitor.keys = keys;
    const double steady = Steady();
    player_.Frame(visitor);
    ahead_ = player_.seconds() - steady;
  }
  const test::GroupPlayer& player() const { return player_; }
  // Time of the drama minus that of the clock, which all devices of the test share.
  double ahead() const { return ahead_; }

 private:
  size_t number_;
  double ahead_ = 0.0;
  int ends_[2] = {-1, -1};
  test::GroupPlayer player_;
  std::unique_ptr<FleetClient> client_;
  std::unique_ptr<StaffLink> link_;
  std::thread thread_;
};

class GroupNetworkTest : public ::testing::Test {
 protected:
  static constexpr size_t kDevices = 8;
  // Seconds, each way: 2 to 80 ms.
  static constexpr double kDelays[kDevices] = {0.002, 0.01, 0.02, 0.03, 0.04, 0.05, 0.065, 0.08};

  void SetUp() override {
    if (!test::TestBroker::installed()) {
      GTEST_SKIP() << "needs Debian's package mosquitto";
    }
    port_ = test::FreePort();
    setup_.folder = folder_ / "fleet";
    setup_.host = "127.0.0.1";
    setup_.site = "pompeii";
    setup_.port = port_;
    setup_.page_port = test::FreePort();
    setup_.broker_folder = (setup_.folder / "broker").string();
    for (size_t i = 0; i < kDevices; ++i) {
      setup_.devices.push_back(Name(i) + ":red");
    }
    ASSERT_TRUE(SetUpFleet(setup_).ok());
    broker_.Start(setup_.broker_folder, port_);
    for (size_t i = 0; i < kDevices; ++i) {
      ports_.push_back(test::FreePort());
      proxies_.push_back(std::make_unique<test::DelayProxy>(
          ports_[i], port_, test::DelayProxy::Way{kDelays[i], 0.008, 0.02}, i + 1));
    }
    began_ = Steady();
  }
  void TearDown() override {
    devices_.clear();
    proxies_.clear();
  }

  static std::string Name(size_t i) { return "tablet-" + std::to_string(i); }
  void Add() {
    const size_t i = devices_.size();
    const std::filesystem::path files = setup_.folder / "devices" / Name(i);
    FleetOptions options;
    options.address = "mqtts://127.0.0.1:" + std::to_string(ports_[i]) + "/pompeii";
    options.name = Name(i);
    options.group = "red";
    options.authority = files / "authority.crt";
    options.password = files / "password";
    devices_.push_back(std::make_unique<NetworkDevice>(options, i, *log_));
  }
  // Plays sixty frames a second. Each second one device's visitor presses a key.
  void Play(double seconds, std::vector<double>* spreads = nullptr) {
    const double begin = Steady();
    for (int frame = 0; Steady() - begin < seconds; ++frame) {
      std::this_thread::sleep_until(Clock::time_point(std::chrono::duration_cast<Clock::duration>(
          std::chrono::duration<double>(begin + frame / 60.0))));
      const size_t presses = frame % 60 == 30 ? static_cast<size_t>(keys_++) % devices_.size() : 99;
      for (size_t i = 0; i < devices_.size(); ++i) {
        if (devices_[i]->runs()) {
          devices_[i]->Frame(Steady() - began_, i == presses ? "a" : "");
        }
      }
      if (spreads != nullptr) {
        spreads->push_back(Spread());
      }
    }
  }
  // Largest difference of the drama's time at one moment.
  double Spread() const {
    double least = 1e9;
    double most = -1e9;
    for (const auto& device : devices_) {
      if (device->runs()) {
        least = std::min(least, device->ahead());
        most = std::max(most, device->ahead());
      }
    }
    return most - least;
  }
  // Plays on for some seconds. Returns how long after now the states of all were the same for good,
  // in whole seconds; -1: they were not.
  double SecondsUntilStatesAgree() {
    constexpr int kMost = 12;
    double now = 0.0;
    for (const auto& device : devices_) {
      now = std::max(now, device->runs() ? device->player().seconds() : 0.0);
    }
    Play(kMost + 6.0);
    for (int later = 0; later < kMost; ++later) {
      const test::ComparedStates states = Compare(now + later);
      if (states.compared > 3 && states.different == 0) {
        return later;
      }
    }
    return -1.0;
  }
  test::ComparedStates Compare(double from) const {
    std::vector<const test::GroupPlayer*> players;
    for (const auto& device : devices_) {
      if (device->runs()) {
        players.push_back(&device->player());
      }
    }
    return test::Compare(players, from);
  }

  using Clock = std::chrono::steady_clock;

  test::TemporaryFolder folder_;
  FleetSetupOptions setup_;
  uint16_t port_ = 0;
  std::vector<uint16_t> ports_;
  std::shared_ptr<Log> log_ = MakeSilentLog();
  test::TestBroker broker_{folder_.path()};
  std::vector<std::unique_ptr<test::DelayProxy>> proxies_;
  std::vector<std::unique_ptr<NetworkDevice>> devices_;
  double began_ = 0.0;
  int keys_ = 0;
};

TEST_F(GroupNetworkTest, OneDramaThroughDelaysLossesAndFailures) {
  for (size_t i = 0; i + 1 < kDevices; ++i) {
    Add();
  }
  Play(6.0);
  std::vector<double> spreads;
  Play(0.7 * kSeconds, &spreads);
  Add();  // The last one, whose way is the longest.
  const double joined = devices_[0]->player().seconds();
  const double late = SecondsUntilStatesAgree();
  const double first =
      static_cast<double>(devices_.back()->player().marks().begin()->first.second) /
      drama::Drama::kTicksPerSecond;
  Play(0.3 * kSeconds, &spreads);
  std::sort(spreads.begin(), spreads.end());
  const test::ComparedStates states = Compare(1.0);
  std::printf(
      "%.0f s: difference of drama time p50 %.1f ms, p95 %.1f ms, worst %.1f ms; %zu states "
      "compared, %zu differ; %d keys; states of a late device agree after "
      "%.0f s, the first is that of %.1f s later\n",
      kSeconds, 1e3 * spreads[spreads.size() / 2], 1e3 * spreads[spreads.size() * 95 / 100],
      1e3 * spreads.back(), states.compared, states.different, keys_, late, first - joined);
  EXPECT_GE(late, 0.0);
  EXPECT_GT(states.compared, 5u);
  EXPECT_EQ(states.different, 0u);

  devices_[0]->End();  // The leader.
  const double after_leader = SecondsUntilStatesAgree();
  std::printf("after the leader went: states agree after %.0f s\n", after_leader);
  EXPECT_GE(after_leader, 0.0);

  broker_.Kill();
  Play(test::IsThorough() ? 30.0 : 4.0);
  broker_.Start(setup_.broker_folder, port_);
  const double after_broker = SecondsUntilStatesAgree();
  std::printf("after the broker was away: states agree after %.0f s\n", after_broker);
  EXPECT_GE(after_broker, 0.0);

  for (size_t i = 1; i < 4; ++i) {
    proxies_[i]->Cut(true);
  }
  Play(test::IsThorough() ? 60.0 : 4.0);
  for (size_t i = 1; i < 4; ++i) {
    proxies_[i]->Cut(false);
  }
  const double after_cut = SecondsUntilStatesAgree();
  std::printf("after three devices were cut off: states agree after %.0f s\n", after_cut);
  EXPECT_GE(after_cut, 0.0);
  for (const auto& device : devices_) {
    EXPECT_GT(device->player().seconds(), 0.0);
  }
}

}  // namespace
}  // namespace lararium::player
