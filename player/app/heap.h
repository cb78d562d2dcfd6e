#pragma once

// Settings of the memory allocator. Loading allocates and frees many large blocks; playing reuses
// few of them again and again. Memory use must not grow over hours.

#include <chrono>

namespace lararium::player {

// Call this before the show's threads start. From now on, large blocks are returned to the system
// as soon as they are freed.
void BeginLoading();

// Returns the memory that loading left free. From now on, blocks of the size of images are kept for
// reuse.
void BeginPlaying();

// While a show is played, HeapKeeper returns free memory to the system at this interval: memory
// that drivers used to compile shaders, people and textures that were replaced by finer ones.
inline constexpr std::chrono::seconds kKeepInterval(10);

}  // namespace lararium::player
