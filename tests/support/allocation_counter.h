#pragma once

// Counts allocations by operator new, and in one thread also calls of malloc. A program that links
// this library has its global allocator replaced: use it only in separate test programs.

namespace lararium::test {

// Counts in any thread from construction until Stop() or destruction.
class AllocationCounter {
 public:
  AllocationCounter();
  ~AllocationCounter();
  AllocationCounter(const AllocationCounter&) = delete;
  AllocationCounter& operator=(const AllocationCounter&) = delete;

  // Stops counting and returns the number of allocations.
  int Stop();
};

struct Allocations {
  int by_new = 0;
  int by_malloc = 0;  // Calls of malloc and similar functions by libraries; 0 with sanitizers.
};

// Counts in the calling thread until CountedInThread().
void CountInThread();
Allocations CountedInThread();

}  // namespace lararium::test
