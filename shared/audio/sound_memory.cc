#include "shared/audio/sound_memory.h"

#include <algorithm>
#include <cstring>

namespace lararium::audio {
namespace {

SoundMemory& MemoryOf(void* user) { return *static_cast<SoundMemory*>(user); }

sf_count_t SizeOf(void* user) { return static_cast<sf_count_t>(MemoryOf(user).bytes.size()); }

sf_count_t MoveTo(sf_count_t offset, int whence, void* user) {
  SoundMemory& memory = MemoryOf(user);
  const sf_count_t base = whence == SEEK_SET   ? 0
                          : whence == SEEK_CUR ? memory.position
                                               : SizeOf(user);
  memory.position = std::clamp<sf_count_t>(base + offset, 0, SizeOf(user));
  return memory.position;
}

sf_count_t ReadNothing(void*, sf_count_t, void*) { return 0; }

sf_count_t Append(const void* from, sf_count_t count, void* user) {
  SoundMemory& memory = MemoryOf(user);
  const auto begin = static_cast<size_t>(memory.position);
  const size_t end = begin + static_cast<size_t>(count);
  memory.bytes.resize(std::max(memory.bytes.size(), end));
  std::memcpy(memory.bytes.data() + begin, from, static_cast<size_t>(count));
  memory.position = static_cast<sf_count_t>(end);
  return count;
}

sf_count_t PositionOf(void* user) { return MemoryOf(user).position; }

}  // namespace

SF_VIRTUAL_IO SoundMemory::Io() { return {SizeOf, MoveTo, ReadNothing, Append, PositionOf}; }

}  // namespace lararium::audio
