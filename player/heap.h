#pragma once

// How a player takes memory: loading makes and drops much that is large, playing little of it again
// and again. Over hours nothing may creep.

#include <chrono>

namespace lararium::player {

// Before a show's threads begin. What is large goes back to the system as soon as it is dropped,
// from now on.
void BeginLoading();

// What loading left goes back, and what images need is kept for the next.
void BeginPlaying();

// How often what is no longer used goes back while a show is played (HeapKeeper): what drivers
// compiled the first pictures' shaders with, people and textures that finer ones took the place of.
inline constexpr std::chrono::seconds kKeepInterval(10);

}  // namespace lararium::player
