#include "shared/core/memory.h"

#include <malloc.h>
#include <sys/mman.h>
#include <sys/prctl.h>

#include <string>

#include "shared/core/sleep.h"

namespace lararium {

void ShareArenas(int arenas) { ::mallopt(M_ARENA_MAX, arenas); }

void KeepPagesSmall() { ::prctl(PR_SET_THP_DISABLE, 1, 0, 0, 0); }

void ReturnBlocksFrom(size_t bytes) {
  ::mallopt(M_MMAP_THRESHOLD, static_cast<int>(bytes));
  ::mallopt(M_TRIM_THRESHOLD, static_cast<int>(2 * bytes));
}

// Pages that cannot be accessed count for the limit of addresses, but need no memory.
Status RequireAddressSpace(uint64_t bytes, std::string_view where) {
  void* const reserved =
      ::mmap(nullptr, bytes, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (reserved == MAP_FAILED) {
    return Status::Error(
        where, "this program may not use " + std::to_string(bytes / 1'000'000) + " MB more memory",
        "raise or lift the limit of its address space (ulimit -v)");
  }
  ::munmap(reserved, bytes);
  return Status();
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
