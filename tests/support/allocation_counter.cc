#include "tests/support/allocation_counter.h"

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdlib>
#include <new>

namespace {

std::atomic<bool> counting = false;
std::atomic<int> allocations = 0;
thread_local bool counting_thread = false;
thread_local lararium::test::Allocations in_thread;

void* Allocate(size_t size, size_t alignment) {
  allocations += counting ? 1 : 0;
  in_thread.by_new += counting_thread ? 1 : 0;
  const int by_malloc = in_thread.by_malloc;
  void* memory = nullptr;
  if (posix_memalign(&memory, std::max(alignment, sizeof(void*)), std::max<size_t>(size, 1)) != 0) {
    std::abort();
  }
  in_thread.by_malloc = by_malloc;
  return memory;
}

}  // namespace

void* operator new(size_t size) { return Allocate(size, 16); }
void* operator new[](size_t size) { return Allocate(size, 16); }
void* operator new(size_t size, std::align_val_t alignment) {
  return Allocate(size, static_cast<size_t>(alignment));
}
void* operator new[](size_t size, std::align_val_t alignment) {
  return Allocate(size, static_cast<size_t>(alignment));
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete[](void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, size_t) noexcept { std::free(memory); }
void operator delete[](void* memory, size_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::align_val_t) noexcept { std::free(memory); }
void operator delete(void* memory, size_t, std::align_val_t) noexcept { std::free(memory); }
void operator delete[](void* memory, size_t, std::align_val_t) noexcept { std::free(memory); }

// The sanitizers replace these functions themselves.
#if defined(__GLIBC__) && !defined(LARARIUM_SANITIZED)
extern "C" {
void* __libc_malloc(size_t size);                      // NOLINT
void* __libc_calloc(size_t count, size_t size);        // NOLINT
void* __libc_realloc(void* memory, size_t size);       // NOLINT
void* __libc_memalign(size_t alignment, size_t size);  // NOLINT

void* malloc(size_t size) {
  in_thread.by_malloc += counting_thread ? 1 : 0;
  return __libc_malloc(size);
}
void* calloc(size_t count, size_t size) {
  in_thread.by_malloc += counting_thread ? 1 : 0;
  return __libc_calloc(count, size);
}
void* realloc(void* memory, size_t size) {
  in_thread.by_malloc += counting_thread ? 1 : 0;
  return __libc_realloc(memory, size);
}
void* aligned_alloc(size_t alignment, size_t size) {
  in_thread.by_malloc += counting_thread ? 1 : 0;
  return __libc_memalign(alignment, size);
}
int posix_memalign(void** memory, size_t alignment, size_t size) {
  in_thread.by_malloc += counting_thread ? 1 : 0;
  *memory = __libc_memalign(alignment, size);
  return *memory == nullptr ? ENOMEM : 0;
}
}
#endif

namespace lararium::test {

AllocationCounter::AllocationCounter() {
  allocations = 0;
  counting = true;
}

AllocationCounter::~AllocationCounter() { counting = false; }

int AllocationCounter::Stop() {
  counting = false;
  return allocations;
}

void CountInThread() {
  in_thread = {};
  counting_thread = true;
}

Allocations CountedInThread() {
  counting_thread = false;
  return in_thread;
}

}  // namespace lararium::test
