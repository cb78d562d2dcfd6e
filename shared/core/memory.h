#pragma once

// How the heap of the GNU C library treats memory that is no longer used.

#include <chrono>
#include <cstddef>
#include <thread>
#include <vector>

namespace lararium {

// Empties items and gives their memory back, which an assignment of {} would keep.
template <typename T>
void Release(std::vector<T>& items) {
  std::vector<T>().swap(items);
}

// All threads share so many arenas, instead of one for each up to eight a core, which all grow in
// time to the most that a thread ever wanted in it. For programs that run for long and do not
// allocate where it is urgent; before threads begin.
void ShareArenas(int arenas);

// Memory is taken in small pages, where the system would round up to huge ones of 2 MiB that are
// never full. Of this process and those that it begins, from now on.
void KeepPagesSmall();

// Blocks of at least so many bytes go back to the system as soon as they are dropped: for work
// that takes much, once. Smaller limits cost time where blocks come and go again and again.
void ReturnBlocksFrom(size_t bytes);

// Whatever is free goes back to the system. Takes milliseconds.
void TrimHeap();

// While it lives, what is free goes back at once and then now and then.
class HeapKeeper {
 public:
  explicit HeapKeeper(std::chrono::steady_clock::duration interval);

 private:
  std::jthread thread_;
};

}  // namespace lararium
