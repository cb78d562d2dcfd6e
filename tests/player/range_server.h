#pragma once

// A web server on this machine that serves a folder, with ranges and with faults.

#include <microhttpd.h>

#include <atomic>
#include <filesystem>
#include <memory>
#include <string>

namespace lararium::test {

class RangeServer {
 public:
  // Listens on a free port.
  explicit RangeServer(std::filesystem::path folder);
  ~RangeServer();
  RangeServer(const RangeServer&) = delete;
  RangeServer& operator=(const RangeServer&) = delete;

  std::string url() const { return "http://127.0.0.1:" + std::to_string(port_) + "/"; }
  // Number of bytes of bundles that were sent.
  uint64_t sent() const { return sent_; }

  std::atomic<bool> knows_ranges = true;
  // The number of bytes of an answer after which the connection is cut; 0: all.
  std::atomic<uint64_t> cut_after = 0;
  // The byte of each file that is altered on the way; -1: none.
  std::atomic<int64_t> altered = -1;

 private:
  struct Answer;

  static MHD_Result Serve(void* self,
                          MHD_Connection* connection,
                          const char* url,
                          const char* method,
                          const char* version,
                          const char* upload,
                          size_t* upload_size,
                          void** state);

  std::filesystem::path folder_;
  MHD_Daemon* daemon_ = nullptr;
  uint16_t port_ = 0;
  std::atomic<uint64_t> sent_ = 0;
};

}  // namespace lararium::test
