#include "player/updates/http_folder.h"

#include <curl/curl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

namespace lararium::player {
namespace {

constexpr long kConnectSeconds = 20;
// A transfer that is slower than this for so long has failed.
constexpr long kSlowBytesPerSecond = 10;
constexpr long kSlowSeconds = 60;
constexpr long kMostRedirections = 5;
constexpr long kWhole = 200;
constexpr long kPart = 206;

// Where received bytes go. Keeps why it stopped a transfer.
struct Sink {
  CURL* handle = nullptr;
  long expected = kWhole;  // HTTP code; the bodies of other answers are not wanted.
  uint64_t room = 0;       // Bytes that are still accepted.
  std::string* text = nullptr;
  int file = -1;
  int error = 0;  // errno
  bool too_much = false;
};

size_t Receive(char* bytes, size_t one, size_t count, void* user) {
  Sink& sink = *static_cast<Sink*>(user);
  const size_t size = one * count;
  long code = 0;
  curl_easy_getinfo(sink.handle, CURLINFO_RESPONSE_CODE, &code);
  if (code != sink.expected) {
    return 0;
  }
  if (size > sink.room) {
    sink.too_much = true;
    return 0;
  }
  sink.room -= size;
  if (sink.text != nullptr) {
    sink.text->append(bytes, size);
    return size;
  }
  for (size_t written = 0; written < size;) {
    const ssize_t now = ::write(sink.file, bytes + written, size - written);
    if (now < 0) {
      sink.error = errno;
      return 0;
    }
    written += static_cast<size_t>(now);
  }
  return size;
}

Status Perform(CURL* handle, const std::string& url, const char* range, Sink& sink) {
  sink.handle = handle;
  curl_easy_setopt(handle, CURLOPT_URL, url.c_str());
  curl_easy_setopt(handle, CURLOPT_RANGE, range);
  curl_easy_setopt(handle, CURLOPT_WRITEDATA, &sink);
  const CURLcode result = curl_easy_perform(handle);
  long code = 0;
  curl_easy_getinfo(handle, CURLINFO_RESPONSE_CODE, &code);
  if (code != 0 && code != sink.expected) {
    return code == kWhole ? Status::Error(url, "the server sends only whole files",
                                          "use a web server that knows ranges, as nginx or Apache")
                          : Status::Error(url, "the server answers " + std::to_string(code),
                                          "publish the show again, or correct the address");
  }
  if (sink.error != 0) {
    return Status::Error(url, std::string("cannot be stored: ") + std::strerror(sink.error),
                         "make room on the disk");
  }
  if (sink.too_much) {
    return Status::Error(url, "is larger than it may be", "publish the show again");
  }
  if (result != CURLE_OK) {
    return Status::Error(url, std::string("cannot be fetched: ") + curl_easy_strerror(result),
                         "it is tried again later");
  }
  return Status();
}

}  // namespace

void HttpFolder::Close::operator()(void* handle) const { curl_easy_cleanup(handle); }

Result<HttpFolder> HttpFolder::Open(const HttpFolderOptions& options) {
  CURL* handle = curl_easy_init();
  if (handle == nullptr) {
    return Status::Error(options.url, "cannot be fetched: libcurl does not start");
  }
  HttpFolder folder(handle, options.url.ends_with('/') ? options.url : options.url + "/");
  curl_easy_setopt(handle, CURLOPT_NOSIGNAL, 1L);
  curl_easy_setopt(handle, CURLOPT_WRITEFUNCTION, &Receive);
  curl_easy_setopt(handle, CURLOPT_PROTOCOLS_STR, "http,https");
  curl_easy_setopt(handle, CURLOPT_FOLLOWLOCATION, 1L);
  curl_easy_setopt(handle, CURLOPT_REDIR_PROTOCOLS_STR, "https");
  curl_easy_setopt(handle, CURLOPT_MAXREDIRS, kMostRedirections);
  curl_easy_setopt(handle, CURLOPT_CONNECTTIMEOUT, kConnectSeconds);
  curl_easy_setopt(handle, CURLOPT_LOW_SPEED_LIMIT, kSlowBytesPerSecond);
  curl_easy_setopt(handle, CURLOPT_LOW_SPEED_TIME, kSlowSeconds);
  curl_easy_setopt(handle, CURLOPT_MAX_RECV_SPEED_LARGE,
                   static_cast<curl_off_t>(options.bytes_per_second));
  if (!options.ca.empty()) {
    curl_easy_setopt(handle, CURLOPT_CAINFO, options.ca.c_str());
  }
  return folder;
}

Result<std::string> HttpFolder::Fetch(const std::string& name, uint64_t max_bytes) {
  std::string text;
  Sink sink{.room = max_bytes, .text = &text};
  LARARIUM_RETURN_IF_ERROR(Perform(handle_.get(), url_ + name, nullptr, sink));
  return text;
}

Status HttpFolder::Append(const std::string& name, uint64_t begin, uint64_t end, int file) {
  const std::string range = std::to_string(begin) + "-" + std::to_string(end - 1);
  Sink sink{.expected = kPart, .room = end - begin, .file = file};
  LARARIUM_RETURN_IF_ERROR(Perform(handle_.get(), url_ + name, range.c_str(), sink));
  return sink.room == 0
             ? Status()
             : Status::Error(url_ + name, "the server sent too little", "publish the show again");
}

}  // namespace lararium::player
