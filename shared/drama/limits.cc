#include "shared/drama/limits.h"

#include <bit>
#include <cstdlib>

#include "shared/drama/lua_api.h"

namespace lararium::drama {
namespace {

constexpr char kTooLong[] = "ran too long without waiting (an endless loop?)";
constexpr char kTooMuchMemory[] = "needs more memory than a script may have";
constexpr char kTooDeep[] = "calls functions in functions too deeply (stack overflow)";
constexpr char kTextTooLong[] = "made a text longer than 64 KiB";

// Lua's stacks have slots of 16 bytes: 40 at first, doubled each time, plus five spare ones
// (ldo.c). No other block of Lua has such a size: others are powers of two, or small.
constexpr size_t kSlotBytes = 16;
constexpr size_t kFirstSlots = 40;
constexpr size_t kSpareSlots = 5;
// Lua's own limit is a million slots. A table that is its own __call shifts the whole stack for
// each slot without running an instruction, which takes minutes for a million slots.
constexpr size_t kMaxSlots = 12'000;

bool IsTooLargeStack(size_t new_size) {
  const size_t slots = new_size / kSlotBytes - kSpareSlots;
  return new_size > (kMaxSlots + kSpareSlots) * kSlotBytes && new_size % kSlotBytes == 0 &&
         slots % kFirstSlots == 0 && std::has_single_bit(slots / kFirstSlots);
}

}  // namespace

void Limits::Refill(int ticks) {
  instructions_left_ = instruction_limit_ * ticks;
  refused_ = false;
  tripped_ = nullptr;
}

bool Limits::Charge(int64_t instructions) {
  instructions_left_ -= instructions;
  if (instructions_left_ < 0 && !tripped()) {
    tripped_ = kTooLong;
  }
  return !tripped();
}

void Limits::TripIfRefused() {
  if (refused_ && !tripped()) {
    tripped_ = kTooMuchMemory;
  }
}

std::string Limits::Reason() const {
  std::string reason = std::string("the script ") + tripped_;
  if (tripped_ == kTooLong) {
    reason += "; call wait() in every loop that lasts";
  } else if (tripped_ == kTooMuchMemory) {
    reason += " (" + std::to_string(memory_limit_ >> 20) + " MiB)";
  }
  return reason;
}

bool Limits::MayGrow(size_t freed, size_t new_size, bool is_text) {
  if (is_text && new_size > kMaxText) {
    tripped_ = tripped() ? tripped_ : kTextTooLong;
    return false;
  }
  if (!tripped() && !Charge(static_cast<int64_t>(new_size / kAllocatedBytesPerInstruction))) {
    return false;
  }
  const size_t limit = memory_limit_ + (tripped() ? kReserve : 0);
  const size_t held = memory_ - freed;
  const bool fits = new_size <= limit && held <= limit - new_size;
  if (!fits && refused_ && !tripped()) {
    tripped_ = kTooMuchMemory;  // Lua has collected garbage and asked again.
  }
  refused_ = !fits;
  return fits;
}

void* Limits::Allocate(void* self, void* block, size_t old_size, size_t new_size) {
  Limits& limits = *static_cast<Limits*>(self);
  // For a new block Lua passes the kind of object instead of the old size.
  const bool is_text = block == nullptr && old_size == LUA_TSTRING;
  const size_t held = block == nullptr ? 0 : old_size;
  if (new_size == 0) {
    std::free(block);
    limits.memory_ -= held;
    return nullptr;
  }
  if (new_size > held && !limits.MayGrow(held, new_size, is_text)) {
    return nullptr;
  }
  if (!is_text && new_size > held && IsTooLargeStack(new_size)) {
    limits.tripped_ = limits.tripped() ? limits.tripped_ : kTooDeep;
    return nullptr;
  }
  void* grown = std::realloc(block, new_size);
  if (grown != nullptr) {
    limits.memory_ += new_size - held;
  }
  return grown;
}

}  // namespace lararium::drama
