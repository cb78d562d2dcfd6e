#pragma once

// What a script may use. Instructions are counted by a hook, and functions in C
// charge for their work; memory is counted by the allocator, which also charges
// for large blocks, because one instruction can copy one.
//
// Once a limit is passed the limits are "tripped": no protected call of the
// script gets control back (safe_base.cc) until the host refills them.

#include <cstddef>
#include <cstdint>
#include <string>

namespace lararium::drama {

class Limits {
 public:
  static constexpr int kHookInterval = 1000;      // instructions
  static constexpr size_t kMaxText = 64 * 1024;   // bytes of one string
  static constexpr size_t kReserve = 256 * 1024;  // bytes, to report a tripped limit with

  Limits(size_t memory_limit, int64_t instruction_limit)
      : memory_limit_(memory_limit), instruction_limit_(instruction_limit) {
    Refill();
  }
  Limits(const Limits&) = delete;
  Limits& operator=(const Limits&) = delete;

  // Grants the instructions of another tick, or of so many.
  void Refill(int ticks = 1);
  // False when no instructions are left; the limits are then tripped.
  bool Charge(int64_t instructions);
  // After an error was caught: it counts as tripped if want of memory caused it.
  void TripIfRefused();

  bool tripped() const { return tripped_ != nullptr; }
  // Which limit was passed, as a sentence for the script's author.
  std::string Reason() const;

  // A lua_Alloc; self is the Limits.
  static void* Allocate(void* self, void* block, size_t old_size, size_t new_size);

 private:
  bool MayGrow(size_t freed, size_t new_size, bool is_text);

  size_t memory_limit_;
  int64_t instruction_limit_;
  size_t memory_ = 0;
  int64_t instructions_left_ = 0;
  bool refused_ = false;  // the last wish for memory
  const char* tripped_ = nullptr;
};

}  // namespace lararium::drama
