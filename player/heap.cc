#include "player/heap.h"

#include <cstddef>

#include "shared/core/memory.h"

namespace lararium::player {
namespace {

constexpr int kArenas = 2;
constexpr size_t kLargeInLoading = 128 << 10;
constexpr size_t kLargeInPlaying = 32 << 20;

}  // namespace

void BeginLoading() {
  ShareArenas(kArenas);
  ReturnBlocksFrom(kLargeInLoading);
}

void BeginPlaying() {
  TrimHeap();
  ReturnBlocksFrom(kLargeInPlaying);
}

void AfterFirstPictures() { TrimHeap(); }

}  // namespace lararium::player
