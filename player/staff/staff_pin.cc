#include "player/staff/staff_pin.h"

#include <sodium.h>

#include <algorithm>
#include <string>

#include "player/kiosk/secret_file.h"

namespace lararium::player {
Result<StaffPin> StaffPin::Load(const std::filesystem::path& path) {
  LARARIUM_ASSIGN_OR_RETURN(std::string line, ReadSecretLine(path));
  Result<StaffPin> pin = Create(line, path.string());
  sodium_memzero(line.data(), line.size());
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
