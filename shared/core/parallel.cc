#include "shared/core/parallel.h"

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>

#include <algorithm>

#ifdef __SANITIZE_THREAD__
#include <sanitizer/tsan_interface.h>
#endif

namespace lararium {
namespace {

// The library that hands work to its threads and waits for them is not
// instrumented, so the thread sanitizer is told what this orders: everything
// before Publish() of an address comes before everything after its Observe().
void Publish([[maybe_unused]] void* address) {
#ifdef __SANITIZE_THREAD__
  __tsan_release(address);
#endif
}
void Observe([[maybe_unused]] void* address) {
#ifdef __SANITIZE_THREAD__
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

ThreadLimit::ThreadLimit(int threads)
    : control_(new tbb::global_control(tbb::global_control::max_allowed_parallelism,
                                       static_cast<size_t>(std::max(threads, 1)))) {}

ThreadLimit::~ThreadLimit() { delete static_cast<tbb::global_control*>(control_); }

}  // namespace lararium
