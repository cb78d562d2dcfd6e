#include "player/fleet/fleet_link.h"

#include <netdb.h>

#include <utility>
#include <vector>

#include "player/fleet/fleet_client.h"
#include "player/kiosk/recent_warnings.h"
#include "player/kiosk/sandbox.h"
#include "player/staff/staff_messages.h"

namespace lararium::player {
namespace {

// Runs the process of the fleet until the player has ended. Returns its exit code.
int Serve(int link, const FleetOptions& options, bool sandbox) {
  // The first look-up loads the libraries of the resolver, which the sandbox does not permit.
  addrinfo* found = nullptr;
  if (::getaddrinfo(options.broker().host.c_str(), nullptr, nullptr, &found) == 0) {
    ::freeaddrinfo(found);
  }
  const auto client = FleetClient::Create(options, link);
  std::vector<std::filesystem::path> files = {options.certificate, options.key};
  if (options.authority.empty()) {  // Links of /etc/ssl/certs lead there.
    files.insert(files.end(), {"/usr/share/ca-certificates", "/usr/local/share/ca-certificates"});
  } else {
    files.push_back(options.authority);
  }
  const Status entered = sandbox ? EnterClientSandbox(files, options.broker().port) : Status();
  for (const Status& status : {client.status(), entered}) {
    if (!status.ok()) {
      SendStaffMessage(link, StaffMessage::kNote, status.message());
    }
  }
  if (client.ok()) {
    (*client)->Run();
  }
  return client.ok() ? 0 : 1;
}

}  // namespace

Result<std::unique_ptr<FleetLink>> FleetLink::Start(FleetOptions options, bool sandbox, Log& log) {
  NameDevice(options);
  LARARIUM_RETURN_IF_ERROR(options.Validate());
  RecentWarnings::Of(log);  // A kiosk's shows inherit the warnings of its watchdog.
  LARARIUM_ASSIGN_OR_RETURN(CompanionProcess process,
                            CompanionProcess::Start("lararium-fleet", {}, [&](int link) {
                              return Serve(link, options, sandbox);
                            }));
  log.Info("fleet: {} as \"{}\"{}", options.address, options.name,
           options.group.empty() ? "" : " in the group \"" + options.group + "\"");
  return std::unique_ptr<FleetLink>(new FleetLink(std::move(process), !options.group.empty()));
}

}  // namespace lararium::player
