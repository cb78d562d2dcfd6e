#pragma once

// Handles with a generation: a handle to a removed value is recognised as stale and never reaches
// the value that replaced it. The zero id is invalid.

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace lararium {

template <typename Tag>
struct Id {
  uint32_t index = 0;
  uint32_t generation = 0;  // A live slot has at least 1.

  explicit operator bool() const { return generation != 0; }
  friend bool operator==(const Id&, const Id&) = default;
};

// Values addressed by Id<T>. ids() returns them in the order of their slots.
template <typename T>
class SlotMap {
 public:
  Id<T> Add(T value) {
    if (free_.empty()) {
      slots_.push_back({std::move(value), 1, true});
      return {static_cast<uint32_t>(slots_.size() - 1), 1};
    }
    const uint32_t index = free_.back();
    free_.pop_back();
    Slot& slot = slots_[index];
    slot.value = std::move(value);
    slot.alive = true;
    return {index, ++slot.generation};
  }

  // Returns false if the id is stale.
  bool Remove(Id<T> id) {
    if (Find(id) == nullptr) {
      return false;
    }
    slots_[id.index].alive = false;
    slots_[id.index].value = T();
    free_.push_back(id.index);
    return true;
  }

  // Returns nullptr if the id is stale or zero.
  T* Find(Id<T> id) { return const_cast<T*>(std::as_const(*this).Find(id)); }
  const T* Find(Id<T> id) const {
    const bool known = id && id.index < slots_.size() && slots_[id.index].alive &&
                       slots_[id.index].generation == id.generation;
    return known ? &slots_[id.index].value : nullptr;
  }

  std::vector<Id<T>> ids() const {
    std::vector<Id<T>> result;
    for (uint32_t i = 0; i < slots_.size(); ++i) {
      if (slots_[i].alive) {
        result.push_back({i, slots_[i].generation});
      }
    }
    return result;
  }
  size_t size() const { return slots_.size() - free_.size(); }

 private:
  struct Slot {
    T value;
    uint32_t generation;
    bool alive;
  };
  std::vector<Slot> slots_;
  std::vector<uint32_t> free_;
};

}  // namespace lararium
