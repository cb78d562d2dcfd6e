#include <chrono>
#include <cstdio>
#include <optional>
#include <variant>

#include "player/app/curtain.h"
#include "player/app/device_file.h"
#include "player/app/doctor.h"
#include "player/app/info.h"
#include "player/app/latency.h"
#include "player/app/options.h"
#include "player/app/play.h"
#include "player/benchmark/benchmark.h"
#include "player/fleet/fleet_link.h"
#include "player/kiosk/kiosk.h"
#include "player/staff/staff_page.h"
#include "player/updates/updater.h"
#include "shared/core/file.h"
#include "shared/core/log.h"
#include "shared/core/program.h"
#include "shared/core/uncaught.h"

namespace {

using namespace lararium;          // NOLINT: the program itself
using namespace lararium::player;  // NOLINT

int Report(const Result<PlayEnd>& end, Log& log) {
  if (!end.ok()) {
    log.Error("{}", end.message());
    return 1;
  }
  return *end == PlayEnd::kStartAgain ? kStartAgain : 0;
}

int Report(const Status& status, Log& log) {
  if (!status.ok()) {
    log.Error("{}", status.message());
  }
  return status.ok() ? 0 : 1;
}

// Starts the staff page; nullptr: none was requested. Call this while there is only one thread and
// before the watchdog of a kiosk starts, so that nothing is started if the port is in use.
Result<std::unique_ptr<StaffPage>> OpenStaffPage(const PlayOptions& options, Log& log) {
  if (options.staff_page.address.empty()) {
    return std::unique_ptr<StaffPage>();
  }
  LARARIUM_ASSIGN_OR_RETURN(const ListenAddress address,
                            ParseListenAddress("--staff-page", options.staff_page.address));
  return StaffPage::Start({address, options.staff_page.pin, options.sandbox}, log);
}

// Joins the fleet of the options, or else of the device file; nullptr: there is none. Call this as
// OpenStaffPage().
Result<std::unique_ptr<FleetLink>> JoinFleet(const PlayOptions& options, Log& log) {
  std::optional<FleetOptions> fleet;
  if (!options.fleet.address.empty()) {
    fleet = options.fleet;
  } else if (!options.camera.device.empty()) {
    LARARIUM_ASSIGN_OR_RETURN(const Device device, LoadDevice(options.camera.device));
    fleet = device.fleet;
  }
  if (!fleet) {
    return std::unique_ptr<FleetLink>();
  }
  return FleetLink::Start(*std::move(fleet), options.sandbox, log);
}

std::filesystem::path UpdateFolder(const PlayOptions& options) {
  return (options.kiosk.state.empty() ? DefaultStateFolder() : options.kiosk.state) / "updates";
}

// Starts the process that fetches newer shows; nullptr: none was requested. Call this while there
// is only one thread.
Result<std::unique_ptr<Updater>> StartUpdater(const PlayOptions& options, Log& log) {
  if (options.updates.url.empty()) {
    return std::unique_ptr<Updater>();
  }
  LARARIUM_ASSIGN_OR_RETURN(const bundle::PublicKey trusted,
                            bundle::LoadPublicKey(options.bundle.trust));
  return Updater::Start(
      {.server = {.url = options.updates.url,
                  .ca = options.updates.ca,
                  .bytes_per_second = 1000.0 * options.updates.kilobytes_per_second},
       .trusted = trusted,
       .folder = UpdateFolder(options),
       .shipped = options.bundle.show,
       .sandbox = options.sandbox},
      log);
}

// Plays a kiosk's show, the newest that there is.
Result<PlayEnd> PlayNewest(PlayOptions options,
                           std::chrono::steady_clock::time_point started,
                           Log& log,
                           PlayLinks links) {
  if (options.updates.url.empty()) {
    return Play(options, started, log, links);
  }
  const UpdateStore store(UpdateFolder(options), options.bundle.show);
  const UpdateStore::Show show = store.Choose(links.start.failed_starts, log);
  options.bundle.show = show.file;
  UpdateWatch watch(store, show.serial, log);
  links.updates = &watch;
  return Play(options, started, log, links);
}

Status SetUp(FleetSetupOptions options, Log& log) {
  options.page = ShippedData("lararium/fleet", "build/fleet-page");
  if (!FileExists(options.page)) {
    log.Info("the fleet's page is left out: scripts/make_fleet_page.sh writes it");
  }
  LARARIUM_ASSIGN_OR_RETURN(const size_t devices, SetUpFleet(options));
  log.Info("{}: {} devices; docs/how-to-run-a-fleet.md says where the files go",
           options.folder.string(), devices);
  return Status();
}

}  // namespace

int main(int argc, char** argv) {
  ReportUncaughtExceptions();
  const auto start = std::chrono::steady_clock::now();
  const Command command = ParseCommandLine(argc, argv);
  if (const int* code = std::get_if<int>(&command)) {
    return *code;
  }
  const auto* play = std::get_if<PlayOptions>(&command);
  const Result<std::shared_ptr<Log>> log = MakeLog(play != nullptr ? play->output.log : "");
  if (!log.ok()) {
    std::fprintf(stderr, "%s\n", log.message().c_str());
    return 1;
  }
  if (const auto* doctor = std::get_if<DoctorOptions>(&command)) {
    return RunDoctor(*doctor, **log) ? 0 : 1;
  }
  if (const auto* latency = std::get_if<LatencyOptions>(&command)) {
    return Report(MeasureLatency(*latency), **log);
  }
  if (const auto* page = std::get_if<PageServerOptions>(&command)) {
    return Report(ServeFleetPage(*page, **log), **log);
  }
  if (const auto* setup = std::get_if<FleetSetupOptions>(&command)) {
    return Report(SetUp(*setup, **log), **log);
  }
  if (play == nullptr) {
    return Report(PrintInfo(std::get<InfoOptions>(command)), **log);
  }
  if (!play->benchmark.folder.empty()) {
    const BenchmarkOptions options{.show = play->bundle.show,
                                   .place = play->bundle.place,
                                   .sequences = play->benchmark.folder,
                                   .foreign = play->benchmark.foreign,
                                   .first_pose = play->benchmark.first_pose,
                                   .unknown_lens = play->benchmark.unknown_lens,
                                   .frames = play->frames,
                                   .threads = play->threads,
                                   .seed = play->seed,
                                   .smoothing = play->smoothing,
                                   .poses_out = play->output.poses,
                                   .stats_out = play->output.stats};
    return Report(Benchmark(options, **log), **log);
  }
  const Result<std::unique_ptr<StaffPage>> page = OpenStaffPage(*play, **log);
  if (!page.ok()) {
    return Report(page.status(), **log);
  }
  const Result<std::unique_ptr<Updater>> updater = StartUpdater(*play, **log);
  if (!updater.ok()) {
    return Report(updater.status(), **log);
  }
  const Result<std::unique_ptr<FleetLink>> fleet = JoinFleet(*play, **log);
  if (!fleet.ok()) {
    return Report(fleet.status(), **log);
  }
  const StaffLinks staff = {*page != nullptr ? (*page)->link() : -1,
                            *fleet != nullptr ? (*fleet)->link() : -1};
  PlayLinks links = {.staff = staff, .in_group = *fleet != nullptr && (*fleet)->in_group()};
  if (*updater != nullptr) {
    links.look_for_update = [&updater] { (*updater)->LookNow(); };
  }
  if (!play->kiosk.enabled) {
    return Report(Play(*play, start, **log, links), **log);
  }
  std::optional<Curtain> curtain;
  if (!play->display.headless && play->display.mode != Display::kOpenXr) {
    curtain.emplace(play->display.monitor, **log);
  }
  const auto child = [&](const ChildStart& number, Heartbeat& heartbeat) {
    const auto begun = number.number == 0 ? start : std::chrono::steady_clock::now();
    links.start = number;
    links.heartbeat = heartbeat;
    return Report(PlayNewest(*play, begun, **log, links), **log);
  };
  return Supervise(child, {}, **log);
}
