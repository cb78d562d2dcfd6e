// A deliberate race: the thread sanitizer must detect races between iterations of a ParallelFor.

#include <chrono>
#include <cstdio>
#include <thread>

#include "shared/core/parallel.h"

int main() {
  int unguarded = 0;
  lararium::ParallelFor(200, [&](size_t) {
    ++unguarded;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  });
  std::printf("%d\n", unguarded);
  return 0;
}
