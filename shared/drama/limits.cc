#include "shared/drama/limits.h"

#include <cstdlib>
#include <lua.hpp>

namespace lararium::drama {
namespace {

constexpr char kTooLong[] = "ran too long without waiting (an endless loop?)";
constexpr char kTooMuchMemory[] = "needs more memory than a script may have";
constexpr char kTextTooLong[] = "made a text longer than 64 KiB";
constexpr size_t kBytesPerInstruction = 64;

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
  if (!tripped() && !Charge(static_cast<int64_t>(new_size / kBytesPerInstruction))) {
    return false;
  }
  const size_t limit = memory_limit_ + (tripped() ? kReserve : 0);
  const size_t held = memory_ - freed;
  const bool fits = new_size <= limit && held <= limit - new_size;
  if (!fits && refused_ && !tripped()) {
    tripped_ = kTooMuchMemory;  // Lua had collected garbage and asked again
  }
  refused_ = !fits;
  return fits;
}

void* Limits::Allocate(void* self, void* block, size_t old_size, size_t new_size) {
  Limits& limits = *static_cast<Limits*>(self);
  // Of a new block Lua tells the kind of object in place of the old size.
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
  void* grown = std::realloc(block, new_size);
  if (grown != nullptr) {
    limits.memory_ += new_size - held;
  }
  return grown;
}

}  // namespace lararium::drama
