#pragma once

// A device's client of the broker (libmosquitto). It publishes what the player tells, and passes
// commands on. It has one thread and a process of its own (fleet_link.h).

#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "player/fleet/command_gate.h"
#include "player/fleet/fleet_options.h"
#include "player/staff/staff_state.h"
#include "shared/core/status.h"
#include "shared/group/group_relay.h"

struct mosquitto;
struct mosquitto_message;

namespace lararium::player {

struct FreeMosquitto {
  void operator()(mosquitto* client) const;
};
using MosquittoClient = std::unique_ptr<mosquitto, FreeMosquitto>;

// Connects to the broker once, in a session of its own, and says why that fails. options are valid.
Status TryFleet(const FleetOptions& options);

class FleetClient {
 public:
  // options are valid. link: socket to the player; it is not closed.
  static Result<std::unique_ptr<FleetClient>> Create(const FleetOptions& options, int link);
  FleetClient(const FleetClient&) = delete;
  FleetClient& operator=(const FleetClient&) = delete;

  // Keeps a connection to the broker until the player has ended. While there is none, it tries
  // again after pauses that double.
  void Run();

 private:
  using Clock = std::chrono::steady_clock;
  struct Calls;  // Callbacks for libmosquitto.

  FleetClient(const FleetOptions& options, int link);
  Status Prepare(const FleetOptions& options);
  bool TakeMessages();  // False: the player has ended.
  void Connect();
  void Serve();
  void Connected(int code);
  void Lost(std::string_view why);
  void Take(const mosquitto_message& message);
  bool GiveToGroup(std::string_view payload, bool to_all);
  void TakeOfGroup(std::string_view topic, std::string_view payload);
  void StepGroup();
  void PublishState();
  void PublishStatistics();
  void PublishPresence(bool online);
  void Note(const std::string& text);

  FleetAddress broker_;
  FleetTopics topics_;
  std::string name_;
  std::string group_;
  std::optional<group::GroupRelay> relay_;  // nullopt: the device is in no group.
  bool group_refused_told_ = false;
  int link_;
  MosquittoClient client_;
  bool has_socket_ = false;  // The broker is connected, or has not answered yet.
  bool connected_ = false;   // The broker has accepted this device.
  bool lost_told_ = false;
  std::string
      library_says_;  // Last error that libmosquitto has logged since a connection was lost.
  Clock::time_point connecting_since_;
  Clock::time_point next_try_;
  std::chrono::seconds pause_{1};
  Clock::time_point published_;
  bool has_news_ = false;
  std::string statistics_;
  bool has_new_statistics_ = false;
  Clock::time_point published_statistics_;
  LastState state_;
  CommandGate gate_;
  std::string buffer_;
};

}  // namespace lararium::player
