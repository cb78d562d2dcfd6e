#pragma once

// How a player takes memory: loading makes and drops much that is large, playing little of it again
// and again. Over hours nothing may creep.

#include <thread>

namespace lararium::player {

// Before a show's threads begin. What is large goes back to the system as soon as it is dropped,
// from now on.
void BeginLoading();

// What loading left goes back, and what images need is kept for the next.
void BeginPlaying();

// While it lives, what is no longer used goes back now and then: what drivers compiled the first
// pictures' shaders with, people and textures that finer ones took the place of.
class HeapKeeper {
 public:
  HeapKeeper();

 private:
  std::jthread thread_;
};

}  // namespace lararium::player
