#pragma once

// Fetches files, and parts of files, of a folder on a web server (libcurl).

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

#include "shared/core/status.h"

namespace lararium::player {

struct HttpFolderOptions {
  std::string url;                // http:// or https://
  std::filesystem::path ca;       // Certificates that are trusted; empty: those of the system.
  double bytes_per_second = 1e6;  // Limit.
};

class HttpFolder {
 public:
  // Call curl_global_init() before.
  static Result<HttpFolder> Open(const HttpFolderOptions& options);

  // Fails if the file is larger than max_bytes.
  Result<std::string> Fetch(const std::string& name, uint64_t max_bytes);
  // Appends the bytes begin..end of a file to an open one. If it fails, the bytes that have arrived
  // are appended.
  Status Append(const std::string& name, uint64_t begin, uint64_t end, int file);

 private:
  struct Close {
    void operator()(void* handle) const;
  };

  HttpFolder(void* handle, std::string url) : handle_(handle), url_(std::move(url)) {}

  std::unique_ptr<void, Close> handle_;
  std::string url_;  // Ends with '/'.
};

}  // namespace lararium::player
