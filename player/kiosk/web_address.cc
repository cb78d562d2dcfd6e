#include "player/kiosk/web_address.h"

#include <arpa/inet.h>
#include <ifaddrs.h>
#include <net/if.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

namespace lararium::player {
namespace {

constexpr int kWaiting = 16;  // limit of connections that wait to be accepted

std::string UrlOf(std::string_view scheme, uint32_t ip, uint16_t port) {
  in_addr address = {};
  address.s_addr = htonl(ip);
  char text[INET_ADDRSTRLEN] = "";
  inet_ntop(AF_INET, &address, text, sizeof(text));
  return std::string(scheme) + "://" + text + ":" + std::to_string(port) + "/";
}

}  // namespace

Result<int> ListenForPage(std::string_view page,
                          std::string_view option,
                          const ListenAddress& address) {
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
  const std::string place = std::string(page) + " " + UrlOf("http", address.ip, address.port);
  if (error == EADDRINUSE) {
    return Status::Error(place, "another program listens there, perhaps another player",
                         "end that program, or choose another port with " + std::string(option));
  }
  return Status::Error(
      place, std::string("cannot be opened: ") + std::strerror(error),
      "choose an address that \"ip -4 address\" lists with " + std::string(option));
}

std::vector<std::string> PageUrls(std::string_view scheme, const ListenAddress& address) {
  if (address.ip != INADDR_ANY) {
    return {UrlOf(scheme, address.ip, address.port)};
  }
  std::vector<std::string> urls;
  ifaddrs* list = nullptr;
  if (getifaddrs(&list) == 0) {
    for (const ifaddrs* entry = list; entry != nullptr; entry = entry->ifa_next) {
      if (entry->ifa_addr != nullptr && entry->ifa_addr->sa_family == AF_INET &&
          (entry->ifa_flags & IFF_LOOPBACK) == 0) {
        sockaddr_in found = {};
        std::memcpy(&found, entry->ifa_addr, sizeof(found));
        urls.push_back(UrlOf(scheme, ntohl(found.sin_addr.s_addr), address.port));
      }
    }
    freeifaddrs(list);
  }
  if (urls.empty()) {
    urls.push_back(UrlOf(scheme, INADDR_LOOPBACK, address.port));
  }
  return urls;
}

}  // namespace lararium::player
