#pragma once

// Counts what operator new is asked for, by any thread. A program that links this
// library has its global allocator replaced: for tests in a program of their own.

namespace lararium::test {

// Counts from its construction until Stop() or its end.
class AllocationCounter {
 public:
  AllocationCounter();
  ~AllocationCounter();
  AllocationCounter(const AllocationCounter&) = delete;
  AllocationCounter& operator=(const AllocationCounter&) = delete;

  // Stops counting and tells.
  int Stop();
};

}  // namespace lararium::test
