#pragma once

// How a player takes memory: loading makes and drops much that is large, playing little of it again
// and again. Over hours nothing may creep.

namespace lararium::player {

// Before a show's threads begin. What is large goes back to the system as soon as it is dropped,
// from now on.
void BeginLoading();

// What loading left goes back, and what images need is kept for the next.
void BeginPlaying();

// What the first pictures left goes back too: drivers compile for them.
void AfterFirstPictures();

}  // namespace lararium::player
