#include "shared/core/parallel.h"

// In a browser there are no threads that share memory: every loop runs in the caller's.

namespace lararium {

void ParallelFor(size_t count, const std::function<void(size_t)>& body) {
  for (size_t i = 0; i < count; ++i) {
    body(i);
  }
}

double ParallelForTimed(size_t count, const std::function<void(size_t)>& body) {
  ParallelFor(count, body);
  return 0.0;
}

ThreadLimit::ThreadLimit(int /*threads*/) : control_(nullptr) {}

ThreadLimit::~ThreadLimit() { static_cast<void>(control_); }

}  // namespace lararium
