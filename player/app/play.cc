#include "player/app/play.h"

#include <csignal>
#include <optional>

#include "player/app/heap.h"
#include "player/app/show_session.h"
#include "player/kiosk/sandbox.h"
#include "shared/core/parallel.h"

namespace lararium::player {
namespace {

void TakeSignal(int /*signal*/) { RequestEnd(); }

void WarnOf(const Status& status, Log& log) {
  if (!status.ok()) {
    log.Warn("{}", status.message());
  }
}

}  // namespace

Result<PlayEnd> Play(const PlayOptions& options,
                     SteadyClock::time_point started,
                     Log& log,
                     const PlayLinks& links) {
  std::signal(SIGINT, TakeSignal);
  std::signal(SIGTERM, TakeSignal);
  std::optional<ThreadLimit> limit;
  if (options.threads > 0) {
    limit.emplace(options.threads);
  }
  const bool sandbox = options.sandbox && options.display.mode != Display::kOpenXr;
  if (options.sandbox && !sandbox) {
    log.Info("no sandbox: the headset's runtime needs the system");
  }
  ShowSession session(options, started, log, links);
  if (sandbox) {
    WarnOf(EnterOpeningSandbox(), log);
  }
  BeginLoading();
  LARARIUM_RETURN_IF_ERROR(session.Prepare());
  BeginPlaying();
  if (sandbox) {
    WarnOf(EnterSandbox(), log);
  }
  return session.Run();
}

}  // namespace lararium::player
