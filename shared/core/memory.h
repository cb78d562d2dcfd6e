#pragma once

// How the heap of the GNU C library treats memory that is no longer used.

#include <cstddef>

namespace lararium {

// Blocks of at least so many bytes go back to the system as soon as they are dropped: for work
// that takes much, once. Smaller limits cost time where blocks come and go again and again.
void ReturnBlocksFrom(size_t bytes);

// Whatever is free goes back to the system. Takes milliseconds.
void TrimHeap();

}  // namespace lararium
