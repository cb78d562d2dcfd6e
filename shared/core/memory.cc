#include "shared/core/memory.h"

#include <malloc.h>
#include <sys/prctl.h>

#include "shared/core/sleep.h"

namespace lararium {

void ShareArenas(int arenas) { ::mallopt(M_ARENA_MAX, arenas); }

void KeepPagesSmall() { ::prctl(PR_SET_THP_DISABLE, 1, 0, 0, 0); }

void ReturnBlocksFrom(size_t bytes) {
  ::mallopt(M_MMAP_THRESHOLD, static_cast<int>(bytes));
  ::mallopt(M_TRIM_THRESHOLD, static_cast<int>(2 * bytes));
}

void TrimHeap() { ::malloc_trim(0); }

HeapKeeper::HeapKeeper(std::chrono::steady_clock::duration interval)
    : thread_([interval](const std::stop_token& stop) {
        while (!stop.stop_requested()) {
          TrimHeap();
          SleepUntil(std::chrono::steady_clock::now() + interval, stop);
        }
      }) {}

}  // namespace lararium
