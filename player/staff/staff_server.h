#pragma once

// The web server of the staff page: a fixed table of routes, no files. It has one thread and a
// process of its own (staff_page.h). It knows only what the player sends, and trusts no client.

#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "player/staff/staff_messages.h"
#include "player/staff/staff_pin.h"
#include "player/staff/staff_state.h"
#include "shared/core/status.h"

struct MHD_Daemon;

namespace lararium::player {

// The relevant parts of a request.
struct StaffRequest {
  std::string_view method;
  std::string_view path;
  std::string_view host;
  std::string_view origin;  // empty: the client sent none
  std::string_view content_type;
  std::string_view accept_language;
  std::string_view pin;  // X-Staff-Pin
  std::string_view body;
};

struct StaffReply {
  int status = 200;
  std::string_view content_type = "text/plain; charset=utf-8";
  std::string body;
  std::vector<std::pair<std::string, std::string>> headers = {};
};

class StaffServer {
 public:
  struct Options {
    int listening = -1;           // listening socket; it is not closed
    int link = -1;                // socket to the player; it is not closed
    std::optional<StaffPin> pin;  // nullopt: the page is read-only
    // Accepted host names, lower case, besides IP addresses and "localhost". Requests for other
    // names may come from pages of attackers (DNS rebinding).
    std::vector<std::string> names;
  };
  // Borrows both sockets of options.
  static Result<std::unique_ptr<StaffServer>> Create(Options options);
  ~StaffServer();
  StaffServer(const StaffServer&) = delete;
  StaffServer& operator=(const StaffServer&) = delete;

  // Serves until the player has ended.
  void Run();

  // Returns the reply to a request.
  StaffReply Answer(const StaffRequest& request);

 private:
  using Clock = std::chrono::steady_clock;
  struct Calls;  // callbacks for libmicrohttpd

  explicit StaffServer(Options options) : options_(std::move(options)) {}
  bool TakeMessages();  // false: the player has ended
  bool IsOurHost(std::string_view host) const;
  StaffReply AnswerRead(const StaffRequest& request);
  StaffReply AnswerWrite(const StaffRequest& request);
  std::optional<StaffReply> RefusePin(std::string_view pin);
  StaffReply Carry(const StaffRequest& request);
  StaffReply State() const;
  StaffReply Picture();

  Options options_;
  MHD_Daemon* daemon_ = nullptr;
  std::string buffer_;
  PinLock lock_;
  Clock::time_point began_ = Clock::now();
  // The last messages of the player, and their times.
  LastState state_;
  std::string statistics_;
  std::string picture_;
  Clock::time_point picture_came_;
  Clock::time_point picture_asked_;
};

}  // namespace lararium::player
