#pragma once

// Controls how the heap of the GNU C library treats unused memory, and tells whether the system
// grants more.

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <thread>

#include "shared/core/status.h"

namespace lararium {

// Lets all threads share this number of arenas. By default there are up to eight arenas for each
// core, and each grows to the largest size that any thread needed in it. For programs that run for
// long and do not allocate in time-critical code. Call it before threads start.
void ShareArenas(int arenas);

// Makes the system use small pages, instead of huge pages of 2 MiB that never fill up. Applies to
// this process and to those that it starts afterwards.
void KeepPagesSmall();

// Returns blocks of at least this number of bytes to the system as soon as they are freed. For work
// that needs much memory once. Small limits cost time if blocks are allocated repeatedly.
void ReturnBlocksFrom(size_t bytes);

// Returns an error if the process may not use this number of bytes of addresses in addition to its
// own, because of a limit such as that of `ulimit -v`. Call it before a library that crashes when
// it gets no memory.
Status RequireAddressSpace(uint64_t bytes, std::string_view where);

// Returns all free memory to the system. Takes milliseconds.
void TrimHeap();

// While it exists, returns free memory to the system at once and then at every interval.
class HeapKeeper {
 public:
  explicit HeapKeeper(std::chrono::steady_clock::duration interval);

 private:
  std::jthread thread_;
};

}  // namespace lararium
