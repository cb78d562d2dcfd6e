#pragma once

// The staff page's web server: a fixed table of addresses, no files. It has one thread and a
// process of its own (staff_page.h), knows of the show what the player sends, and believes nobody.

#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "player/staff_messages.h"
#include "player/staff_pin.h"
#include "shared/core/status.h"

struct MHD_Daemon;

namespace lararium::player {

// A request, as far as it counts.
struct StaffRequest {
  std::string_view method;
  std::string_view path;
  std::string_view host;
  std::string_view origin;  // empty: the browser says none, or it is none
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
    int listening = -1;           // a socket; kept
    int link = -1;                // to the player; kept
    std::optional<StaffPin> pin;  // none: the page only shows
    // That the page may be asked for by, beside numbers and "localhost"; lower case. Other names
    // are those of strangers' pages, which a browser was led here from (DNS rebinding).
    std::vector<std::string> names;
  };
  static constexpr size_t kMostBody = 1024;  // bytes

  // Borrows both sockets.
  static Result<std::unique_ptr<StaffServer>> Create(Options options);
  ~StaffServer();
  StaffServer(const StaffServer&) = delete;
  StaffServer& operator=(const StaffServer&) = delete;

  // Serves until the player is gone.
  void Run();

  // What is answered to a request.
  StaffReply Answer(const StaffRequest& request);

 private:
  using Clock = std::chrono::steady_clock;
  struct Calls;  // libmicrohttpd's

  explicit StaffServer(Options options) : options_(std::move(options)) {}
  bool TakeMessages();  // false: the player is gone
  bool IsOurHost(std::string_view host) const;
  StaffReply AnswerRead(const StaffRequest& request);
  StaffReply AnswerWrite(const StaffRequest& request);
  std::optional<StaffReply> RefusePin(std::string_view pin);
  StaffReply Carry(const StaffRequest& request);
  StaffReply State() const;
  StaffReply Picture();
  bool PlayerAnswers() const;

  Options options_;
  MHD_Daemon* daemon_ = nullptr;
  std::string buffer_;
  PinLock lock_;
  Clock::time_point began_ = Clock::now();
  // What the player said last, and when.
  std::string state_;
  std::string statistics_;
  std::string picture_;
  Clock::time_point state_came_;
  Clock::time_point picture_came_;
  Clock::time_point picture_asked_;
};

}  // namespace lararium::player
