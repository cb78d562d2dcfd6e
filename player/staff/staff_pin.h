#pragma once

// The PIN that the staff must enter before they can change anything, and a lock against guessing.

#include <array>
#include <cstddef>
#include <filesystem>
#include <string_view>

#include "shared/core/status.h"

namespace lararium::player {

// Keeps only a keyed hash of the PIN; the key is random for each run.
class StaffPin {
 public:
  static constexpr size_t kLeast = 6;  // characters
  static constexpr size_t kMost = 64;

  // Reads a text file whose first line is the PIN: 6 to 64 printable ASCII characters without
  // spaces. A file that users other than its owner and group can read or write is an error.
  static Result<StaffPin> Load(const std::filesystem::path& path);
  // For tests. where: name of the PIN in errors.
  static Result<StaffPin> Create(std::string_view pin, std::string_view where);

  // Compares in constant time for guesses of the same length.
  bool Is(std::string_view guess) const;

 private:
  static constexpr size_t kBytes = 32;
  using Hash = std::array<unsigned char, kBytes>;
  Hash HashOf(std::string_view text) const;

  Hash key_ = {};
  Hash hash_ = {};
};

// Counts wrong tries of all clients together, because an attacker can use many addresses.
class PinLock {
 public:
  static constexpr int kFreeTries = 5;
  static constexpr double kFirstSeconds = 60.0;  // doubled by each further wrong try
  static constexpr double kMostSeconds = 900.0;

  // Seconds until the next try is accepted; 0: it is accepted now. now: seconds of a steady clock.
  double LockedFor(double now) const { return now < locked_until_ ? locked_until_ - now : 0.0; }
  void Wrong(double now);
  void Right() { *this = {}; }
  int wrong_tries() const { return wrong_; }  // number since the last right one

 private:
  int wrong_ = 0;
  double locked_until_ = 0.0;
};

}  // namespace lararium::player
