#include "player/fleet/page_server.h"

#include <microhttpd.h>
#include <poll.h>

#include <csignal>
#include <cstring>
#include <string_view>
#include <system_error>
#include <utility>

#include "player/kiosk/sandbox.h"
#include "player/kiosk/web_address.h"
#include "shared/core/file.h"

namespace lararium::player {
namespace {

constexpr uint64_t kMostPageBytes = 16 << 20;
constexpr unsigned kMostPageConnections = 128;
constexpr unsigned kIdlePageSeconds = 20;
constexpr int kLookUpMs = 200;

constexpr std::pair<std::string_view, const char*> kTypes[] = {
    {".html", "text/html; charset=utf-8"},
    {".css", "text/css; charset=utf-8"},
    {".js", "text/javascript; charset=utf-8"},
    {".json", "application/json"}};
constexpr std::pair<const char*, const char*> kPageHeaders[] = {
    {"X-Content-Type-Options", "nosniff"},
    {"X-Frame-Options", "DENY"},
    {"Referrer-Policy", "no-referrer"},
    {"Cache-Control", "no-cache"}};

volatile std::sig_atomic_t g_page_ends = 0;

}  // namespace

struct PageServer::Calls {
  static MHD_Result Handle(void* server,
                           MHD_Connection* connection,
                           const char* path,
                           const char* method,
                           const char* /*version*/,
                           const char* /*upload*/,
                           size_t* /*upload_size*/,
                           void** /*context*/) {
    const auto& files = static_cast<PageServer*>(server)->files_;
    const auto found = files.find(std::string_view(path));
    const bool reads = std::strcmp(method, "GET") == 0 || std::strcmp(method, "HEAD") == 0;
    static constexpr std::string_view kNothing = "there is nothing here\n";
    const std::string_view text =
        found != files.end() && reads ? std::string_view(found->second.content) : kNothing;
    MHD_Response* response =
        MHD_create_response_from_buffer(text.size(), const_cast<char*>(text.data()),
                                        MHD_RESPMEM_PERSISTENT);  // NOLINT: not changed
    for (const auto& [name, value] : kPageHeaders) {
      MHD_add_response_header(response, name, value);
    }
    MHD_add_response_header(response, "Content-Type",
                            found != files.end() && reads ? found->second.type : "text/plain");
    const unsigned status = !reads ? 405 : found == files.end() ? 404 : 200;
    const MHD_Result queued = MHD_queue_response(connection, status, response);
    MHD_destroy_response(response);
    return queued;
  }
};

Result<std::unique_ptr<PageServer>> PageServer::Create(const std::filesystem::path& folder,
                                                       int listening) {
  std::unique_ptr<PageServer> server(new PageServer());
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(folder / "page", error)) {
    for (const auto& [extension, type] : kTypes) {
      if (entry.path().extension() == extension) {
        LARARIUM_ASSIGN_OR_RETURN(std::string text, ReadText(entry.path(), kMostPageBytes));
        server->files_["/" + entry.path().filename().string()] = {std::move(text), type};
      }
    }
  }
  const auto index = server->files_.find("/index.html");
  if (index == server->files_.end()) {
    return Status::Error((folder / "page").string(), "has no page of a fleet",
                         "run scripts/make_fleet_page.sh, then fleet-setup");
  }
  server->files_["/"] = index->second;
  LARARIUM_ASSIGN_OR_RETURN(server->certificate_, ReadText(folder / "server.crt", kMostPageBytes));
  LARARIUM_ASSIGN_OR_RETURN(server->key_, ReadText(folder / "server.key", kMostPageBytes));
  server->daemon_ = MHD_start_daemon(
      MHD_USE_EPOLL_INTERNAL_THREAD | MHD_USE_TLS, 0, nullptr, nullptr, &Calls::Handle,
      server.get(), MHD_OPTION_LISTEN_SOCKET, listening, MHD_OPTION_CONNECTION_LIMIT,
      kMostPageConnections, MHD_OPTION_CONNECTION_TIMEOUT, kIdlePageSeconds,
      MHD_OPTION_HTTPS_MEM_CERT, server->certificate_.c_str(), MHD_OPTION_HTTPS_MEM_KEY,
      server->key_.c_str(), MHD_OPTION_END);
  if (server->daemon_ == nullptr) {
    return Status::Error(folder.string(), "its certificate cannot be used",
                         "copy the broker's folder again");
  }
  return server;
}

PageServer::~PageServer() {
  if (daemon_ != nullptr) {
    MHD_stop_daemon(daemon_);
  }
}

Status ServeFleetPage(const PageServerOptions& options, Log& log) {
  for (const int signal : {SIGINT, SIGTERM}) {
    std::signal(signal, [](int /*signal*/) { g_page_ends = 1; });
  }
  std::signal(SIGPIPE, SIG_IGN);
  LARARIUM_ASSIGN_OR_RETURN(const ListenAddress address,
                            ParseListenAddress("--address", options.address));
  LARARIUM_ASSIGN_OR_RETURN(const int listening, ListenForPage("fleet page", "--address", address));
  LARARIUM_ASSIGN_OR_RETURN(const std::unique_ptr<PageServer> server,
                            PageServer::Create(options.folder, listening));
  for (const std::string& url : PageUrls("https", address)) {
    log.Info("fleet page: {}", url);
  }
  if (options.sandbox) {
    LARARIUM_RETURN_IF_ERROR(EnterPageSandbox(listening));
  }
  while (g_page_ends == 0) {
    ::poll(nullptr, 0, kLookUpMs);
  }
  return Status();
}

}  // namespace lararium::player
