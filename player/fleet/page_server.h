#pragma once

// Serves the page of a fleet by HTTPS (libmicrohttpd): a fixed table of files that are read once.

#include <filesystem>
#include <map>
#include <memory>
#include <string>

#include "player/kiosk/listen_address.h"
#include "shared/core/log.h"
#include "shared/core/status.h"

struct MHD_Daemon;

namespace lararium::player {

struct PageServerOptions {
  std::filesystem::path
      folder;  // The broker's folder of fleet-setup: page/, server.crt, server.key.
  std::string address = "0.0.0.0:8443";  // See ParseListenAddress().
  bool sandbox = true;
};

class PageServer {
 public:
  // Serves at once, on a thread of its own. listening: socket that listens; it is not closed.
  static Result<std::unique_ptr<PageServer>> Create(const std::filesystem::path& folder,
                                                    int listening);
  ~PageServer();
  PageServer(const PageServer&) = delete;
  PageServer& operator=(const PageServer&) = delete;

 private:
  struct Calls;  // Callbacks for libmicrohttpd.
  struct File {
    std::string content;
    const char* type;
  };

  PageServer() = default;

  std::map<std::string, File, std::less<>> files_;  // key: path of the address
  std::string certificate_;
  std::string key_;
  MHD_Daemon* daemon_ = nullptr;
};

// Serves until the process gets SIGINT or SIGTERM.
Status ServeFleetPage(const PageServerOptions& options, Log& log);

}  // namespace lararium::player
