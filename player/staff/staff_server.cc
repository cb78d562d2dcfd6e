#include "player/staff/staff_server.h"

#include <arpa/inet.h>
#include <microhttpd.h>
#include <poll.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

#include "player/staff/staff_texts.h"
#include "shared/core/json.h"
#include "shared/core/lower_case.h"

namespace lararium::player {
namespace {

constexpr unsigned kMostConnections = 32;
constexpr unsigned kMostFromOneAddress = 12;  // browsers open six
constexpr unsigned kIdleSeconds = 10;
constexpr size_t kMemoryOfConnection = 16 << 10;  // bytes, headers included
// Bytes of a body that is too long which are read and ignored before the connection is closed.
constexpr size_t kMostDiscarded = 64 << 10;
constexpr int kLongestPollMs = 1000;
constexpr double kPictureSeconds = 6.0;  // older pictures are discarded
constexpr double kPictureAskSeconds = 1.0;

constexpr std::string_view kJson = "application/json";

// A path of the server. does: POST requests perform an action; other paths are only read.
struct Route {
  std::string_view path;
  bool does = false;
};
constexpr Route kRoutes[] = {
    {"/"},           {"/page.css"},       {"/page.js"},   {"/parts.js"},     {"/state.json"},
    {"/mirror.jpg"}, {"/statistics.csv"}, {"/pin", true}, {"/command", true}};

// The page may not load anything from other sites, and other pages may not embed it.
constexpr std::pair<const char*, const char*> kHeaders[] = {
    {"Content-Security-Policy",
     "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' blob:; connect-src "
     "'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'"},
    {"X-Content-Type-Options", "nosniff"},
    {"X-Frame-Options", "DENY"},
    {"Referrer-Policy", "no-referrer"},
    {"Cross-Origin-Resource-Policy", "same-origin"},
    {"Cross-Origin-Opener-Policy", "same-origin"},
    {"Cache-Control", "no-store"},
};

double SecondsSince(std::chrono::steady_clock::time_point time) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - time).count();
}

StaffReply Refusal(int status, std::string_view why) {
  return {.status = status, .body = std::string(why) + "\n"};
}

StaffReply FileNamed(std::string_view name, std::string_view content_type) {
  const auto files = StaffPageFiles();
  const auto found = std::find_if(files.begin(), files.end(),
                                  [&](const EmbeddedText& f) { return f.name == name; });
  return {.content_type = content_type, .body = std::string(found->text)};
}

// A request whose body may not have arrived completely.
struct Incoming {
  std::string body;
  size_t bytes = 0;
};

std::string_view Header(MHD_Connection* connection, const char* name) {
  const char* value = MHD_lookup_connection_value(connection, MHD_HEADER_KIND, name);
  return value == nullptr ? std::string_view() : std::string_view(value);
}

MHD_Result Send(MHD_Connection* connection, const StaffReply& reply) {
  MHD_Response* response = MHD_create_response_from_buffer(
      reply.body.size(), const_cast<char*>(reply.body.data()),  // NOLINT: it is copied
      MHD_RESPMEM_MUST_COPY);
  if (response == nullptr) {
    return MHD_NO;
  }
  for (const auto& [name, value] : kHeaders) {
    MHD_add_response_header(response, name, value);
  }
  MHD_add_response_header(response, "Content-Type", std::string(reply.content_type).c_str());
  for (const auto& [name, value] : reply.headers) {
    MHD_add_response_header(response, name.c_str(), value.c_str());
  }
  const MHD_Result queued =
      MHD_queue_response(connection, static_cast<unsigned>(reply.status), response);
  MHD_destroy_response(response);
  return queued;
}

// True if a request announces a body that is too long to be read.
bool AnnouncesTooMuch(MHD_Connection* connection) {
  const std::string length(Header(connection, "Content-Length"));
  return !length.empty() && std::strtoull(length.c_str(), nullptr, 10) > kMostStaffCommand;
}

}  // namespace

// The C callbacks, which get the server as a void pointer.
struct StaffServer::Calls {
  static MHD_Result Handle(void* server,
                           MHD_Connection* connection,
                           const char* path,
                           const char* method,
                           const char* /*version*/,
                           const char* upload,
                           size_t* upload_size,
                           void** context) {
    if (*context == nullptr) {
      *context = new Incoming;  // NOLINT: Forget deletes it
      return AnnouncesTooMuch(connection) ? Send(connection, TooMuch()) : MHD_YES;
    }
    auto& incoming = *static_cast<Incoming*>(*context);
    if (*upload_size > 0) {
      incoming.bytes += *upload_size;
      if (incoming.bytes <= kMostStaffCommand) {
        incoming.body.append(upload, *upload_size);
      }
      *upload_size = 0;
      return incoming.bytes <= kMostDiscarded ? MHD_YES : MHD_NO;
    }
    if (incoming.bytes > kMostStaffCommand) {
      return Send(connection, TooMuch());
    }
    return Send(connection, static_cast<StaffServer*>(server)->Answer(
                                {.method = method,
                                 .path = path,
                                 .host = Header(connection, "Host"),
                                 .origin = Header(connection, "Origin"),
                                 .content_type = Header(connection, "Content-Type"),
                                 .accept_language = Header(connection, "Accept-Language"),
                                 .pin = Header(connection, "X-Staff-Pin"),
                                 .body = incoming.body}));
  }

  static void Forget(void* /*server*/,
                     MHD_Connection* /*connection*/,
                     void** context,
                     MHD_RequestTerminationCode /*why*/) {
    delete static_cast<Incoming*>(*context);  // NOLINT: Handle made it
    *context = nullptr;
  }

  static StaffReply TooMuch() { return Refusal(413, "too much: a command has at most 1024 bytes"); }
};

Result<std::unique_ptr<StaffServer>> StaffServer::Create(Options options) {
  std::unique_ptr<StaffServer> server(new StaffServer(std::move(options)));
  server->daemon_ = MHD_start_daemon(
      MHD_USE_EPOLL, 0, nullptr, nullptr, &Calls::Handle, server.get(), MHD_OPTION_LISTEN_SOCKET,
      server->options_.listening, MHD_OPTION_CONNECTION_LIMIT, kMostConnections,
      MHD_OPTION_PER_IP_CONNECTION_LIMIT, kMostFromOneAddress, MHD_OPTION_CONNECTION_TIMEOUT,
      kIdleSeconds, MHD_OPTION_CONNECTION_MEMORY_LIMIT, kMemoryOfConnection,
      MHD_OPTION_STRICT_FOR_CLIENT, 1, MHD_OPTION_NOTIFY_COMPLETED, &Calls::Forget, server.get(),
      MHD_OPTION_END);
  if (server->daemon_ == nullptr) {
    return Status::Error("staff page", "cannot start its web server");
  }
  return server;
}

StaffServer::~StaffServer() {
  if (daemon_ != nullptr) {
    MHD_stop_daemon(daemon_);
  }
}

void StaffServer::Run() {
  const int events = MHD_get_daemon_info(daemon_, MHD_DAEMON_INFO_EPOLL_FD)->epoll_fd;
  while (true) {
    MHD_UNSIGNED_LONG_LONG wait = kLongestPollMs;
    if (MHD_get_timeout(daemon_, &wait) != MHD_YES) {
      wait = kLongestPollMs;
    }
    pollfd waiting[] = {{events, POLLIN, 0}, {options_.link, POLLIN, 0}};
    ::poll(waiting, std::size(waiting),
           static_cast<int>(std::min<MHD_UNSIGNED_LONG_LONG>(wait, kLongestPollMs)));
    if (waiting[1].revents != 0 && !TakeMessages()) {
      return;
    }
    if (SecondsSince(picture_came_) > kPictureSeconds) {
      picture_.clear();
    }
    MHD_run(daemon_);
  }
}

bool StaffServer::TakeMessages() {
  bool open = true;
  while (const auto message = ReceiveStaffMessage(options_.link, buffer_, open)) {
    if (message->kind == StaffMessage::kState) {
      state_.Set(message->content);
    } else if (message->kind == StaffMessage::kPicture) {
      picture_ = message->content;
      picture_came_ = Clock::now();
    } else if (message->kind == StaffMessage::kStatistics) {
      statistics_ = message->content;
    }
  }
  return open;
}

bool StaffServer::IsOurHost(std::string_view host) const {
  if (host.starts_with('[')) {
    return host.find(']') != std::string_view::npos;  // an IPv6 address
  }
  const std::string name = LowerCase(host.substr(0, host.find(':')));
  in_addr number = {};
  return name == "localhost" || inet_pton(AF_INET, name.c_str(), &number) == 1 ||
         std::find(options_.names.begin(), options_.names.end(), name) != options_.names.end();
}

StaffReply StaffServer::Answer(const StaffRequest& request) {
  if (!IsOurHost(request.host)) {
    return Refusal(421, "open this page by its IP address, for example http://192.168.1.5:8090/");
  }
  const auto* route = std::find_if(std::begin(kRoutes), std::end(kRoutes),
                                   [&](const Route& r) { return r.path == request.path; });
  if (route == std::end(kRoutes)) {
    return Refusal(404, "there is nothing here");
  }
  const bool looks = request.method == "GET" || request.method == "HEAD";
  if (route->does ? request.method != "POST" : !looks) {
    StaffReply reply = Refusal(405, "this cannot be done here");
    reply.headers.emplace_back("Allow", route->does ? "POST" : "GET, HEAD");
    return reply;
  }
  return route->does ? AnswerWrite(request) : AnswerRead(request);
}

StaffReply StaffServer::AnswerRead(const StaffRequest& request) {
  if (request.path == "/state.json") {
    return State();
  }
  if (request.path == "/mirror.jpg") {
    return Picture();
  }
  if (request.path == "/statistics.csv") {
    return statistics_.empty()
               ? Refusal(404, "days are counted with --kiosk")
               : StaffReply{.content_type = "text/csv; charset=utf-8", .body = statistics_};
  }
  if (request.path == "/page.css") {
    return FileNamed("page.css", "text/css; charset=utf-8");
  }
  if (request.path == "/page.js" || request.path == "/parts.js") {
    return FileNamed(request.path.substr(1), "text/javascript; charset=utf-8");
  }
  return {.content_type = "text/html; charset=utf-8",
          .body = StaffPageIn(StaffLanguage(request.accept_language)),
          .headers = {{"Vary", "Accept-Language"}}};
}

StaffReply StaffServer::State() const {
  const Json pin = {{"set", options_.pin.has_value()},
                    {"locked_seconds", lock_.LockedFor(SecondsSince(began_))}};
  return {.content_type = kJson, .body = state_.ToJson({{"pin", pin}})};
}

// Returns the last picture. Each request also asks the player for a new one.
StaffReply StaffServer::Picture() {
  if (SecondsSince(picture_asked_) >= kPictureAskSeconds) {
    picture_asked_ = Clock::now();
    SendStaffMessage(options_.link, StaffMessage::kPictureWanted, "");
  }
  if (picture_.empty() || SecondsSince(picture_came_) > kPictureSeconds) {
    StaffReply reply = Refusal(503, "there is no picture yet");
    reply.headers.emplace_back("Retry-After", "1");
    return reply;
  }
  return {.content_type = "image/jpeg", .body = picture_};
}

// Browsers send the origin of the page that makes a request. A client without an origin is not a
// browser.
StaffReply StaffServer::AnswerWrite(const StaffRequest& request) {
  if (!request.origin.empty() && LowerCase(request.origin) != "http://" + LowerCase(request.host)) {
    return Refusal(403, "requests from other pages are not allowed");
  }
  if (!options_.pin) {
    return Refusal(403, "the player was started without a PIN: this page only shows");
  }
  if (std::optional<StaffReply> refused = RefusePin(request.pin)) {
    return *std::move(refused);
  }
  return request.path == "/command" ? Carry(request) : StaffReply{.body = "the PIN is right\n"};
}

std::optional<StaffReply> StaffServer::RefusePin(std::string_view pin) {
  const double now = SecondsSince(began_);
  const auto locked = [&] {
    StaffReply reply = Refusal(429, "too many wrong tries");
    reply.headers.emplace_back("Retry-After",
                               std::to_string(std::lround(std::ceil(lock_.LockedFor(now)))));
    return reply;
  };
  if (lock_.LockedFor(now) > 0.0) {
    return locked();
  }
  if (options_.pin->Is(pin)) {
    lock_.Right();
    return std::nullopt;
  }
  lock_.Wrong(now);
  SendStaffMessage(options_.link, StaffMessage::kNote,
                   "a wrong PIN was given; wrong tries: " + std::to_string(lock_.wrong_tries()));
  return lock_.LockedFor(now) > 0.0 ? locked() : Refusal(401, "this is not the PIN");
}

StaffReply StaffServer::Carry(const StaffRequest& request) {
  if (!request.content_type.starts_with(kJson)) {
    return Refusal(415, "a command is application/json");
  }
  if (const Result<StaffCommand> command = ParseStaffCommand(request.body); !command.ok()) {
    return Refusal(400, command.message());
  }
  if (!state_.answers() || !SendStaffMessage(options_.link, StaffMessage::kCommand, request.body)) {
    return Refusal(503, "the show does not answer");
  }
  return {.status = 202, .body = "told\n"};
}

}  // namespace lararium::player
