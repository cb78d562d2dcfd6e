#include "tests/player/range_server.h"

#include <gtest/gtest.h>
#include <netinet/in.h>

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <utility>

#include "shared/core/file.h"

namespace lararium::test {

// The bytes of one answer.
struct RangeServer::Answer {
  RangeServer& server;
  std::string bytes;

  static ssize_t Read(void* self, uint64_t position, char* buffer, size_t size) {
    const Answer& answer = *static_cast<Answer*>(self);
    const uint64_t cut = answer.server.cut_after;
    const uint64_t end =
        cut > 0 ? std::min<uint64_t>(cut, answer.bytes.size()) : answer.bytes.size();
    if (position >= end) {
      return MHD_CONTENT_READER_END_WITH_ERROR;
    }
    const size_t count = std::min<uint64_t>(size, end - position);
    std::memcpy(buffer, answer.bytes.data() + position, count);
    answer.server.sent_ += count;
    return static_cast<ssize_t>(count);
  }
  static void Free(void* self) { delete static_cast<Answer*>(self); }
};

MHD_Result RangeServer::Serve(void* self,
                              MHD_Connection* connection,
                              const char* url,
                              const char* /*method*/,
                              const char* /*version*/,
                              const char* /*upload*/,
                              size_t* /*upload_size*/,
                              void** /*state*/) {
  RangeServer& server = *static_cast<RangeServer*>(self);
  const std::string name(url + 1);
  const auto file = name.find('/') == std::string::npos ? ReadText(server.folder_ / name)
                                                        : Status::Error(name, "not served");
  unsigned code = file.ok() ? MHD_HTTP_OK : MHD_HTTP_NOT_FOUND;
  std::string bytes = file.ok() ? *file : "not found";
  if (const int64_t at = server.altered; at >= 0 && at < static_cast<int64_t>(bytes.size())) {
    bytes[static_cast<size_t>(at)] ^= 1;
  }
  uint64_t first = 0;
  uint64_t last = 0;
  const char* range = MHD_lookup_connection_value(connection, MHD_HEADER_KIND, "Range");
  if (code == MHD_HTTP_OK && server.knows_ranges && range != nullptr &&
      std::sscanf(range, "bytes=%lu-%lu", &first, &last) == 2 && first < bytes.size()) {
    bytes = bytes.substr(first, last - first + 1);
    code = MHD_HTTP_PARTIAL_CONTENT;
  }
  const uint64_t size = bytes.size();
  MHD_Response* response = MHD_create_response_from_callback(
      size, 4096, &Answer::Read, new Answer{server, std::move(bytes)}, &Answer::Free);
  const MHD_Result queued = MHD_queue_response(connection, code, response);
  MHD_destroy_response(response);
  return queued;
}

RangeServer::RangeServer(std::filesystem::path folder) : folder_(std::move(folder)) {
  sockaddr_in address = {};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  daemon_ = MHD_start_daemon(MHD_USE_INTERNAL_POLLING_THREAD, 0, nullptr, nullptr, &Serve, this,
                             MHD_OPTION_SOCK_ADDR, &address, MHD_OPTION_END);
  EXPECT_NE(daemon_, nullptr);
  port_ = MHD_get_daemon_info(daemon_, MHD_DAEMON_INFO_BIND_PORT)->port;
}

RangeServer::~RangeServer() { MHD_stop_daemon(daemon_); }

}  // namespace lararium::test
