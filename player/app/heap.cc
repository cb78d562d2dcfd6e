#include "player/app/heap.h"

#include <cstddef>

#include "shared/core/memory.h"

namespace lararium::player {
namespace {

constexpr int kArenas = 2;
constexpr size_t kLargeInLoading = 128 << 10;
constexpr size_t kLargeInPlaying = 32 << 20;

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

}  // namespace lararium::player
