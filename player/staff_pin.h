#pragma once

// The PIN that staff give before they may change anything, and how guessing it is made hopeless.

#include <array>
#include <cstddef>
#include <filesystem>
#include <string_view>

#include "shared/core/status.h"

namespace lararium::player {

// Of a PIN only a keyed hash is kept, with a key of this run.
class StaffPin {
 public:
  static constexpr size_t kLeast = 6;  // characters
  static constexpr size_t kMost = 64;

  // A text file whose first line is the PIN: 6 to 64 printable characters of ASCII. One that
  // others than its owner and group may read is refused, as is one that they may write.
  static Result<StaffPin> Load(const std::filesystem::path& path);
  // For tests: place is what errors call it.
  static Result<StaffPin> Create(std::string_view pin, std::string_view place);

  // Takes as long for any guess of the same length.
  bool Is(std::string_view guess) const;

 private:
  static constexpr size_t kBytes = 32;
  using Hash = std::array<unsigned char, kBytes>;
  Hash HashOf(std::string_view text) const;

  Hash key_ = {};
  Hash hash_ = {};
};

// Counts wrong tries, whoever makes them: an address is cheap.
class PinLock {
 public:
  static constexpr int kFreeTries = 5;
  static constexpr double kFirstSeconds = 60.0;  // doubled by each wrong try after it
  static constexpr double kMostSeconds = 900.0;

  // Seconds until the next try is taken; 0: now. now: of a steady clock.
  double LockedFor(double now) const { return now < locked_until_ ? locked_until_ - now : 0.0; }
  void Wrong(double now);
  void Right() { *this = {}; }
  int wrong_tries() const { return wrong_; }  // since the last right one

 private:
  int wrong_ = 0;
  double locked_until_ = 0.0;
};

}  // namespace lararium::player
