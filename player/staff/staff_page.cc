#include "player/staff/staff_page.h"

#include <arpa/inet.h>
#include <ifaddrs.h>
#include <net/if.h>
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
#include "player/staff/staff_server.h"
#include "shared/core/lower_case.h"

namespace lararium::player {
namespace {

constexpr int kWaiting = 16;  // limit of connections that wait to be accepted

std::string UrlOf(uint32_t ip, uint16_t port) {
  in_addr address = {};
  address.s_addr = htonl(ip);
  char text[INET_ADDRSTRLEN] = "";
  inet_ntop(AF_INET, &address, text, sizeof(text));
  return std::string("http://") + text + ":" + std::to_string(port) + "/";
}

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

Result<int> ListenForStaff(const ListenAddress& address) {
  const int file = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
  const int yes = 1;
  sockaddr_in bound = {};
  bound.sin_family = AF_INET;
  bound.sin_addr.s_addr = htonl(address.ip);
  bound.sin_port = htons(address.port);
  if (file >= 0 && ::setsockopt(file, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof(yes)) == 0 &&
      ::bind(file, reinterpret_cast<const sockaddr*>(&bound), sizeof(bound)) == 0 &&
      ::listen(file, kWaiting) == 0) {
    return file;
  }
  const int error = errno;
  if (file >= 0) {
    ::close(file);
  }
  const std::string place = "staff page " + UrlOf(address.ip, address.port);
  if (error == EADDRINUSE) {
    return Status::Error(place, "another program listens there, perhaps another player",
                         "end that program, or choose another port with --staff-page");
  }
  return Status::Error(place, std::string("cannot be opened: ") + std::strerror(error),
                       "choose an address that \"ip -4 address\" lists with --staff-page");
}

std::vector<std::string> StaffPageUrls(const ListenAddress& address) {
  if (address.ip != INADDR_ANY) {
    return {UrlOf(address.ip, address.port)};
  }
  std::vector<std::string> urls;
  ifaddrs* list = nullptr;
  if (getifaddrs(&list) == 0) {
    for (const ifaddrs* entry = list; entry != nullptr; entry = entry->ifa_next) {
      if (entry->ifa_addr != nullptr && entry->ifa_addr->sa_family == AF_INET &&
          (entry->ifa_flags & IFF_LOOPBACK) == 0) {
        sockaddr_in found = {};
        std::memcpy(&found, entry->ifa_addr, sizeof(found));
        urls.push_back(UrlOf(ntohl(found.sin_addr.s_addr), address.port));
      }
    }
    freeifaddrs(list);
  }
  if (urls.empty()) {
    urls.push_back(UrlOf(INADDR_LOOPBACK, address.port));
  }
  return urls;
}

Result<std::unique_ptr<StaffPage>> StaffPage::Start(const StaffPageOptions& options, Log& log) {
  std::optional<StaffPin> pin;
  if (!options.pin_file.empty()) {
    LARARIUM_ASSIGN_OR_RETURN(pin, StaffPin::Load(options.pin_file));
  }
  LARARIUM_ASSIGN_OR_RETURN(const int listening, ListenForStaff(options.address));
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
  for (const std::string& url : StaffPageUrls(address)) {
    log.Info("staff page: {} ({})", url, pin ? "with the PIN" : "it only shows");
  }
  return std::unique_ptr<StaffPage>(new StaffPage(*std::move(process), address.port));
}

}  // namespace lararium::player
