#include "player/app/osc.h"

#include <lo/lo.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <optional>
#include <utility>

#include "shared/drama/visitor.h"

namespace lararium::player {
namespace {

constexpr std::string_view kPlace = "OSC packet";
constexpr size_t kMaxPacket = 65536;
constexpr int kMaxDepth = 4;
constexpr int kMaxArguments = 8;
constexpr size_t kMaxWord = 400;
constexpr size_t kMaxWaiting = 256;
constexpr char kBundle[] = "#bundle";  // 8 bytes with the terminating 0
constexpr size_t kBundleHead = 16;     // kBundle and the time

// The type of a message is void* up to liblo 0.31, and a pointer to a struct later.
struct MessageDeleter {
  using pointer = lo_message;
  void operator()(lo_message message) const { lo_message_free(message); }
};

// Checks an address. It must not contain the characters that separate it from its arguments in a
// word of the drama.
bool IsAddress(std::string_view address) {
  return address.size() > 1 && address.front() == '/' &&
         std::all_of(address.begin(), address.end(),
                     [](char c) { return c > 0x20 && c < 0x7f && c != ',' && c != '#'; });
}

template <typename T>
std::string NumberText(T value) {
  std::array<char, 32> digits;
  const auto [end, error] = std::to_chars(digits.data(), digits.data() + digits.size(), value);
  return error == std::errc() ? std::string(digits.data(), end) : "N";
}

template <typename T>
Status AddNumber(T value, std::string& word) {
  if (!std::isfinite(static_cast<double>(value))) {
    return Status::Error(kPlace, "holds a number that is not finite");
  }
  word += "," + NumberText(value);
  return Status();
}

// Reads an argument. All arguments lie at multiples of four bytes, so 8-byte types may be
// unaligned.
template <typename T>
T Read(const void* argument) {
  T value;
  std::memcpy(&value, argument, sizeof(value));
  return value;
}

Status AddArgument(char type, const void* argument, std::string& word) {
  switch (type) {
    case LO_INT32:
      return AddNumber(Read<int32_t>(argument), word);
    case LO_INT64:
      return AddNumber(Read<int64_t>(argument), word);
    case LO_FLOAT:
      return AddNumber(Read<float>(argument), word);
    case LO_DOUBLE:
      return AddNumber(Read<double>(argument), word);
    case LO_STRING:
    case LO_SYMBOL:
      word += "," + drama::MessageText(static_cast<const char*>(argument));
      return Status();
    case LO_TRUE:
    case LO_FALSE:
      word += type == LO_TRUE ? ",T" : ",F";
      return Status();
    case LO_NIL:
    case LO_INFINITUM:
      word += ",N";
      return Status();
    default:
      return Status::Error(kPlace, "has an argument of an unsupported type");
  }
}

// The length of the zero-terminated text at the beginning of a packet; nullopt: no terminator.
std::optional<size_t> TextLength(std::span<const std::byte> packet) {
  const auto end = std::find(packet.begin(), packet.end(), std::byte{0});
  return end == packet.end() ? std::nullopt : std::optional(end - packet.begin());
}

Status ParseMessage(std::span<const std::byte> packet, std::vector<std::string>& words) {
  const std::optional<size_t> length = TextLength(packet);
  const char* text = reinterpret_cast<const char*>(packet.data());
  if (!length || !IsAddress({text, *length}) || packet.size() % 4 != 0) {
    return Status::Error(kPlace, "is not a valid message of Open Sound Control 1.0");
  }
  // A copy, because liblo converts the byte order of numbers in place.
  std::vector<std::byte> copy(packet.begin(), packet.end());
  int error = 0;
  const std::unique_ptr<void, MessageDeleter> message(
      lo_message_deserialise(copy.data(), copy.size(), &error));
  if (message == nullptr) {
    return Status::Error(kPlace, "has arguments that do not match its types");
  }
  const int count = lo_message_get_argc(message.get());
  if (count > kMaxArguments) {
    return Status::Error(kPlace, "has more than 8 arguments");
  }
  std::string word(text, *length);
  for (int i = 0; i < count; ++i) {
    LARARIUM_RETURN_IF_ERROR(AddArgument(lo_message_get_types(message.get())[i],
                                         lo_message_get_argv(message.get())[i], word));
  }
  if (word.size() > kMaxWord) {
    return Status::Error(kPlace, "is longer than 400 bytes");
  }
  words.push_back(std::move(word));
  return Status();
}

uint32_t ReadSize(std::span<const std::byte> bytes) {
  uint32_t size = 0;
  std::memcpy(&size, bytes.data(), sizeof(size));
  return ntohl(size);
}

Status ParsePacket(std::span<const std::byte> packet, int depth, std::vector<std::string>& words) {
  const bool is_bundle =
      packet.size() >= kBundleHead && std::memcmp(packet.data(), kBundle, sizeof(kBundle)) == 0;
  if (!is_bundle) {
    return ParseMessage(packet, words);
  }
  if (depth >= kMaxDepth) {
    return Status::Error(kPlace, "nests bundles too deeply");
  }
  packet = packet.subspan(kBundleHead);
  while (!packet.empty()) {
    const size_t size = packet.size() >= 4 ? ReadSize(packet) : packet.size();
    if (packet.size() < 4 || size > packet.size() - 4 || size == 0 || words.size() >= kMaxWaiting) {
      return Status::Error(kPlace, "is a bundle that is cut off or contains too many messages");
    }
    LARARIUM_RETURN_IF_ERROR(ParsePacket(packet.subspan(4, size), depth + 1, words));
    packet = packet.subspan(4 + size);
  }
  return Status();
}

}  // namespace

Result<std::vector<std::string>> ParseOsc(std::span<const std::byte> packet) {
  std::vector<std::string> words;
  LARARIUM_RETURN_IF_ERROR(ParsePacket(packet, 0, words));
  return words;
}

Result<std::unique_ptr<OscListener>> OscListener::Open(const ListenAddress& address, Log& log) {
  const int file = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  sockaddr_in bound = {};
  bound.sin_family = AF_INET;
  bound.sin_addr.s_addr = htonl(address.ip);
  bound.sin_port = htons(address.port);
  socklen_t size = sizeof(bound);
  if (file < 0 || bind(file, reinterpret_cast<const sockaddr*>(&bound), sizeof(bound)) != 0 ||
      getsockname(file, reinterpret_cast<sockaddr*>(&bound), &size) != 0) {
    const std::string why = std::strerror(errno);
    if (file >= 0) {
      close(file);
    }
    return Status::Error("OSC port " + std::to_string(address.port), "cannot be opened: " + why,
                         "choose another port with --osc");
  }
  return std::unique_ptr<OscListener>(new OscListener(file, ntohs(bound.sin_port), log));
}

OscListener::OscListener(int socket, uint16_t port, Log& log)
    : socket_(socket),
      port_(port),
      log_(log),
      thread_([this](const std::stop_token& stop) { Run(stop); }) {}

OscListener::~OscListener() {
  thread_.request_stop();
  thread_.join();
  close(socket_);
}

std::vector<std::string> OscListener::Take() {
  const std::lock_guard lock(mutex_);
  return std::exchange(words_, {});
}

void OscListener::Refuse(const Status& status) {
  if (refused_++ % 100 == 0) {
    log_.Warn("{}; {} refused so far", status.message(), refused_);
  }
}

void OscListener::Run(const std::stop_token& stop) {
  constexpr int kLookUpMs = 100;
  std::vector<std::byte> buffer(kMaxPacket);
  while (!stop.stop_requested()) {
    pollfd waiting = {socket_, POLLIN, 0};
    if (poll(&waiting, 1, kLookUpMs) <= 0) {
      continue;
    }
    const ssize_t size = recv(socket_, buffer.data(), buffer.size(), MSG_DONTWAIT);
    if (size < 0) {
      continue;
    }
    const auto words = ParseOsc(std::span(buffer).first(static_cast<size_t>(size)));
    if (!words.ok()) {
      Refuse(words.status());
      continue;
    }
    const std::lock_guard lock(mutex_);
    for (const std::string& word : *words) {
      if (words_.size() < kMaxWaiting) {
        words_.push_back(word);
      }
    }
  }
}

}  // namespace lararium::player
