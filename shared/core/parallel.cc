#include "shared/core/parallel.h"

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>

#include <algorithm>

namespace lararium {

void ParallelFor(size_t count, const std::function<void(size_t)>& body) {
  tbb::parallel_for(size_t{0}, count, body);
}

ThreadLimit::ThreadLimit(int threads)
    : control_(new tbb::global_control(tbb::global_control::max_allowed_parallelism,
                                       static_cast<size_t>(std::max(threads, 1)))) {}

ThreadLimit::~ThreadLimit() { delete static_cast<tbb::global_control*>(control_); }

}  // namespace lararium
