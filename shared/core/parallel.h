#pragma once

#include <cstddef>
#include <functional>

namespace lararium {

// Calls body(i) once for each i in [0, count), on all cores, in no particular order, and waits.
// Write results to separate locations and merge them in index order afterwards, so that the outcome
// does not depend on the number of cores.
void ParallelFor(size_t count, const std::function<void(size_t)>& body);

// Same as ParallelFor. Returns the processor milliseconds that threads other than the caller's
// spent in body.
double ParallelForTimed(size_t count, const std::function<void(size_t)>& body);

// Limits the number of threads of every ParallelFor while it exists.
class ThreadLimit {
 public:
  explicit ThreadLimit(int threads);
  ~ThreadLimit();
  ThreadLimit(const ThreadLimit&) = delete;
  ThreadLimit& operator=(const ThreadLimit&) = delete;

 private:
  void* control_;
};

}  // namespace lararium
