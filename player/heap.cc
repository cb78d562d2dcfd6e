#include "player/heap.h"

#include <chrono>
#include <cstddef>

#include "shared/core/memory.h"
#include "shared/core/sleep.h"

namespace lararium::player {
namespace {

constexpr int kArenas = 2;
constexpr size_t kLargeInLoading = 128 << 10;
constexpr size_t kLargeInPlaying = 32 << 20;
constexpr std::chrono::seconds kKeepInterval(10);

}  // namespace

void BeginLoading() {
  KeepPagesSmall();
  ShareArenas(kArenas);
  ReturnBlocksFrom(kLargeInLoading);
}

void BeginPlaying() {
  TrimHeap();
  ReturnBlocksFrom(kLargeInPlaying);
}

HeapKeeper::HeapKeeper()
    : thread_([](const std::stop_token& stop) {
        while (!stop.stop_requested()) {
          TrimHeap();
          SleepUntil(std::chrono::steady_clock::now() + kKeepInterval, stop);
        }
      }) {}

}  // namespace lararium::player
