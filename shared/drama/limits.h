#pragma once

// Resource limits of a script. A hook counts instructions, and C++ functions charge for their work.
// The allocator counts memory and also charges for large blocks, because one instruction can copy
// one.
//
// When a limit is exceeded, the limits are "tripped": no protected call of the script regains
// control (safe_base.cc) until the host calls Refill().

#include <cstddef>
#include <cstdint>
#include <string>

namespace lararium::drama {

// Work on this number of bytes is charged as one instruction.
inline constexpr size_t kAllocatedBytesPerInstruction = 64;

class Limits {
 public:
  static constexpr int kHookInterval = 1000;      // Instructions.
  static constexpr size_t kMaxText = 64 * 1024;   // Bytes of one string.
  static constexpr size_t kReserve = 256 * 1024;  // Extra bytes for reporting a tripped limit.

  Limits(size_t memory_limit, int64_t instruction_limit)
      : memory_limit_(memory_limit), instruction_limit_(instruction_limit) {
    Refill();
  }
  Limits(const Limits&) = delete;
  Limits& operator=(const Limits&) = delete;

  // Sets the budget to the instructions of `ticks` ticks and clears a tripped limit.
  void Refill(int ticks = 1);
  // Returns false if no instructions are left; the limits are then tripped.
  bool Charge(int64_t instructions);
  // Call it after an error was caught: trips the limits if a refused allocation caused the error.
  void TripIfRefused();

  bool tripped() const { return tripped_ != nullptr; }
  // Describes the exceeded limit to the author of the script.
  std::string Reason() const;

  // A lua_Alloc; `self` is the Limits.
  static void* Allocate(void* self, void* block, size_t old_size, size_t new_size);

 private:
  bool MayGrow(size_t freed, size_t new_size, bool is_text);

  size_t memory_limit_;
  int64_t instruction_limit_;
  size_t memory_ = 0;
  int64_t instructions_left_ = 0;
  bool refused_ = false;  // The last allocation was refused.
  const char* tripped_ = nullptr;
};

}  // namespace lararium::drama
