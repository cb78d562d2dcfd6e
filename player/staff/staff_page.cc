#include "player/staff/staff_page.h"

#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <optional>
#include <utility>

#include "player/kiosk/recent_warnings.h"
#include "player/kiosk/sandbox.h"
#include "player/kiosk/web_address.h"
#include "player/staff/staff_server.h"
#include "shared/core/lower_case.h"

namespace lararium::player {
namespace {

// Names of this machine on the network, for example "kiosk" and "kiosk.local".
std::vector<std::string> NamesOfMachine() {
  char text[256] = "";
  if (::gethostname(text, sizeof(text) - 1) != 0 || text[0] == '\0') {
    return {};
  }
  const std::string name = LowerCase(text);
  const std::string first = name.substr(0, name.find('.'));
  return {name, first, first + ".local"};
}

// Runs the page's process until it ends. Returns its exit code.
int Serve(int listening, int link, std::optional<StaffPin> pin, bool sandbox) {
  std::vector<std::string> names = NamesOfMachine();
  const auto server = StaffServer::Create(
      {.listening = listening, .link = link, .pin = std::move(pin), .names = std::move(names)});
  const Status entered = sandbox ? EnterPageSandbox(listening) : Status();
  for (const Status& status : {server.status(), entered}) {
    if (!status.ok()) {
      SendStaffMessage(link, StaffMessage::kNote, status.message());
    }
  }
  if (server.ok()) {
    (*server)->Run();
  }
  return server.ok() ? 0 : 1;
}

}  // namespace

Result<std::unique_ptr<StaffPage>> StaffPage::Start(const StaffPageOptions& options, Log& log) {
  std::optional<StaffPin> pin;
  if (!options.pin_file.empty()) {
    LARARIUM_ASSIGN_OR_RETURN(pin, StaffPin::Load(options.pin_file));
  }
  LARARIUM_ASSIGN_OR_RETURN(const int listening,
                            ListenForPage("staff page", "--staff-page", options.address));
  sockaddr_in bound = {};
  socklen_t size = sizeof(bound);
  if (::getsockname(listening, reinterpret_cast<sockaddr*>(&bound), &size) != 0) {
    ::close(listening);
    return Status::Error("staff page", std::strerror(errno));
  }
  // Starts collecting warnings, so that a kiosk's shows inherit those of its watchdog.
  RecentWarnings::Of(log);
  const ListenAddress address = {options.address.ip, ntohs(bound.sin_port)};
  Result<CompanionProcess> process = CompanionProcess::Start(
      "lararium-page", std::array{listening},
      [&](int link) { return Serve(listening, link, std::move(pin), options.sandbox); });
  ::close(listening);
  if (!process.ok()) {
    return process.status();
  }
  for (const std::string& url : PageUrls("http", address)) {
    log.Info("staff page: {} ({})", url, pin ? "with the PIN" : "it only shows");
  }
  return std::unique_ptr<StaffPage>(new StaffPage(*std::move(process), address.port));
}

}  // namespace lararium::player
