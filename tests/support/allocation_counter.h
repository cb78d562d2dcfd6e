#pragma once

// Counts allocations by operator new, in any thread. A program that links this library has its
// global allocator replaced: use it only in separate test programs.

namespace lararium::test {

// Counts from construction until Stop() or destruction.
class AllocationCounter {
 public:
  AllocationCounter();
  ~AllocationCounter();
  AllocationCounter(const AllocationCounter&) = delete;
  AllocationCounter& operator=(const AllocationCounter&) = delete;

  // Stops counting and returns the number of allocations.
  int Stop();
};

}  // namespace lararium::test
