#include "shared/core/parallel.h"

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <thread>

#include "shared/core/statistics.h"

#ifdef LARARIUM_THREAD_SANITIZER
#include <sanitizer/tsan_interface.h>
#endif

namespace lararium {
namespace {

// The library that distributes work to threads is not instrumented, and neither is this file
// (CMakeLists.txt), because half of the library would then be. Therefore we tell the thread
// sanitizer what is ordered: everything before Publish() of an address comes before everything
// after its Observe(). Iterations are not ordered.
void Publish([[maybe_unused]] void* address) {
#ifdef LARARIUM_THREAD_SANITIZER
  __tsan_release(address);
#endif
}
void Observe([[maybe_unused]] void* address) {
#ifdef LARARIUM_THREAD_SANITIZER
  __tsan_acquire(address);
#endif
}

}  // namespace

void ParallelFor(size_t count, const std::function<void(size_t)>& body) {
  char begun = 0;
  char done = 0;
  Publish(&begun);
  tbb::parallel_for(size_t{0}, count, [&](size_t i) {
    Observe(&begun);
    body(i);
    Publish(&done);
  });
  Observe(&done);
}

double ParallelForTimed(size_t count, const std::function<void(size_t)>& body) {
  const std::thread::id caller = std::this_thread::get_id();
  std::atomic<double> helpers_ms = 0.0;
  ParallelFor(count, [&](size_t i) {
    if (std::this_thread::get_id() == caller) {
      body(i);
      return;
    }
    const double before = ThreadCpuMilliseconds();
    body(i);
    helpers_ms += ThreadCpuMilliseconds() - before;
  });
  return helpers_ms;
}

ThreadLimit::ThreadLimit(int threads)
    : control_(new tbb::global_control(tbb::global_control::max_allowed_parallelism,
                                       static_cast<size_t>(std::max(threads, 1)))) {}

ThreadLimit::~ThreadLimit() { delete static_cast<tbb::global_control*>(control_); }

}  // namespace lararium
