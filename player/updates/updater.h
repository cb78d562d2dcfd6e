#pragma once

// Fetches the newest show from a web server while another one plays (docs/player.md). A process of
// its own does it, so that no frame waits for the network, and the process that plays has none.

#include <sys/types.h>

#include <filesystem>
#include <memory>
#include <string>

#include "player/updates/http_folder.h"
#include "player/updates/update_store.h"
#include "shared/bundle/signature.h"
#include "shared/core/log.h"
#include "shared/core/status.h"

namespace lararium::player {

struct UpdaterOptions {
  HttpFolderOptions server;  // The folder of lararium-editor publish.
  bundle::PublicKey trusted;
  std::filesystem::path folder;     // See UpdateStore.
  std::filesystem::path shipped;    // See UpdateStore.
  double interval_seconds = 600.0;  // Time between two looks at the server.
  bool sandbox = true;
};

// Looks at the server once. Fetches the newest show if it is newer than all that were fetched
// before, and of it only what no show at hand has; a fetch that was interrupted is continued. The
// show is verified as a whole before it counts. Returns whether there is a new show. On failure the
// shows at hand stay as they are.
Result<bool> FetchNewest(const UpdaterOptions& options, const UpdateStore& store);

// The process that looks at the server again and again, until the object is destroyed or the
// program ends. It logs a fault once when it begins and once when it is over.
class Updater {
 public:
  // Call this while there is only one thread.
  static Result<std::unique_ptr<Updater>> Start(const UpdaterOptions& options, Log& log);
  ~Updater();
  Updater(const Updater&) = delete;
  Updater& operator=(const Updater&) = delete;

  pid_t process() const { return process_; }
  // Makes the process look at the server now. Any process that was forked since may call it.
  void LookNow() const;

 private:
  Updater(pid_t process, int bell) : process_(process), bell_(bell) {}

  pid_t process_;
  int bell_;  // An eventfd that wakes the process.
};

}  // namespace lararium::player
