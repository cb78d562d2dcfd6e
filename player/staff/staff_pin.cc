#include "player/staff/staff_pin.h"

#include <sodium.h>
#include <sys/stat.h>

#include <algorithm>
#include <string>

#include "shared/core/file.h"
#include "shared/core/plain_text.h"

namespace lararium::player {
namespace {

constexpr uint64_t kMostFileBytes = 4096;

}  // namespace

Result<StaffPin> StaffPin::Load(const std::filesystem::path& path) {
  struct stat info = {};
  if (::stat(path.c_str(), &info) == 0 && (info.st_mode & (S_IROTH | S_IWOTH)) != 0) {
    return Status::Error(path.string(), "other users of this machine can read or write it",
                         "chmod 600 " + path.string());
  }
  LARARIUM_ASSIGN_OR_RETURN(std::string bytes, ReadText(path, kMostFileBytes));
  std::string text = PlainText(bytes);
  std::string_view line = std::string_view(text).substr(0, text.find('\n'));
  line = line.substr(0, line.find_last_not_of(" \t") + 1);
  Result<StaffPin> pin = Create(line, path.string());
  sodium_memzero(bytes.data(), bytes.size());
  sodium_memzero(text.data(), text.size());
  return pin;
}

Result<StaffPin> StaffPin::Create(std::string_view pin, std::string_view where) {
  const bool printable =
      std::all_of(pin.begin(), pin.end(), [](char c) { return c > 0x20 && c < 0x7f; });
  if (pin.size() < kLeast || pin.size() > kMost || !printable) {
    return Status::Error(where, "its first line is not a valid PIN",
                         "write 6 to 64 digits or letters there, without spaces");
  }
  if (sodium_init() < 0) {
    return Status::Error(where, "the system does not provide random numbers");
  }
  StaffPin made;
  randombytes_buf(made.key_.data(), made.key_.size());
  made.hash_ = made.HashOf(pin);
  return made;
}

StaffPin::Hash StaffPin::HashOf(std::string_view text) const {
  Hash hash;
  crypto_generichash(hash.data(), hash.size(), reinterpret_cast<const unsigned char*>(text.data()),
                     text.size(), key_.data(), key_.size());
  return hash;
}

bool StaffPin::Is(std::string_view guess) const {
  const Hash hash = HashOf(guess.substr(0, kMost + 1));
  return sodium_memcmp(hash.data(), hash_.data(), hash_.size()) == 0;
}

void PinLock::Wrong(double now) {
  ++wrong_;
  if (wrong_ >= kFreeTries) {
    const int beyond = std::min(wrong_ - kFreeTries, 10);
    locked_until_ = now + std::min(kFirstSeconds * (1 << beyond), kMostSeconds);
  }
}

}  // namespace lararium::player
